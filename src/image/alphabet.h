// In: nothing. Out: the letters, as dots on a raster of 5 × 9 whose neighbours are joined when they are
// drawn.
#pragma once

#include <span>
#include <string_view>

namespace sahl {

struct Letter {
    char32_t code;
    std::string_view
        dots; // rows from the top, parted by '/': seven to the base line, two below; '#' is a dot
};

/// Printable ASCII and the signs that titles and units of optics need.
std::span<Letter const> alphabet();

} // namespace sahl

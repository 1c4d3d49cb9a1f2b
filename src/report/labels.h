// In: names and where the things are that they belong to. Out: text beside them, placed so that names do not
// overlap.
#pragma once

#include "math/vec.h"

#include <string>
#include <vector>

namespace sahl::report {

/// A rectangle in pixels, y downwards.
struct PixelBox {
    dvec2 low{0.0}, high{0.0};
};

struct Label {
    std::string text; // not escaped
    PixelBox of;      // what it names
    char const* kind; // CSS class
};

/// Each name above, below, right or left of its thing, at the first of these places that is free and inside
/// `frame`; a name that finds none is left out (every outline shows its name under the pointer).
std::string labels_svg(std::vector<Label> const& labels, PixelBox const& frame);

} // namespace sahl::report

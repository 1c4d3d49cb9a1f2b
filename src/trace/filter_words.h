// In: the text of a path filter. Out: its words, each with its place.
#pragma once

#include "trace/filter_syntax.h"

namespace sahl {

struct FilterWord {
    enum class Kind { word, quoted, symbol, end } kind = Kind::end;
    std::string text{}; // of quoted words without the quotes
    FilterSpan span{};

    bool is(std::string_view what) const {
        return (kind == Kind::word || kind == Kind::symbol) && text == what;
    }
};

/// The last is of kind `end`. Throws InputError where quotes are not closed, or at a character that is
/// nothing.
std::vector<FilterWord> filter_words(std::string_view text, std::string const& place);

} // namespace sahl

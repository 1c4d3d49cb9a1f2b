// In: a misspelt word and the known ones. Out: the one that was probably meant.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace sahl {

/// Levenshtein distance: single-character insertions, deletions and replacements that turn one word into the
/// other.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            std::size_t const above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

/// The known word nearest to `word` by edit distance, the first of equals; empty only where none is known.
inline std::string nearest_name(std::string_view word, std::vector<std::string> const& known) {
    auto const best = std::min_element(known.begin(), known.end(), [&](auto const& a, auto const& b) {
        return edit_distance(word, a) < edit_distance(word, b);
    });
    return best == known.end() ? std::string() : *best;
}

} // namespace sahl

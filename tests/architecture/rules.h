// In: the text of a source file. Out: its includes, and for each what is wrong with it by the rules of the
// house: rooms include one way, and each library has one door. The rules are the two tables in rules.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sahl {

struct Include {
    std::string file; // relative to src/: "optics/snell.cpp"
    int line;         // from 1
    std::string path; // as written between the quotes or brackets
    bool quoted;
};

/// The #include lines of a file. `file` is its path relative to src/.
std::vector<Include> includes_of(std::string const& file, std::string_view text);

/// Why this include may not be, or nothing.
std::string problem_with(Include const& include);

} // namespace sahl

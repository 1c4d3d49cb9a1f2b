// In: names, numbers and values of a summary. Out: pieces of HTML, escaped, and numbers as a person reads
// them. Everything that comes from a file passes through `text` or `attribute` on its way to the page.
#pragma once

#include "math/vec.h"
#include "scene/value.h"

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sahl::report {

/// The same text where HTML expects text or a quoted attribute: &, <, >, both quotes as entities, control
/// characters (which HTML forbids) as U+FFFD.
std::string escaped(std::string_view text);

/// A relative path as it may stand in src="": all but letters, digits and -._~/ is percent-encoded, so that
/// neither a scheme, a query nor a fragment can arise.
std::string relative_url(std::string_view path);

/// At most `most` characters (UTF-8 code points), the last an ellipsis where something is cut off. Not
/// escaped.
std::string shortened(std::string_view text, std::size_t most);

/// Six significant digits with a true minus; powers of ten as 1.5×10<sup>−7</sup>. "not finite" where it is
/// not.
std::string figure(double value, int digits = 6);

/// A count with its thousands apart: 1 000 000.
std::string count(std::uint64_t value);

/// A share as per cent, four significant digits; below 0.0001 % as a power of ten.
std::string per_cent(double share);

/// A coordinate in a drawing: two decimals at most, no −0.
std::string coordinate(double pixels);

/// The value under a path of keys, or nullptr; null counts as absent.
Value const* at(Value const& value, std::initializer_list<std::string_view> path);
std::optional<double> number_at(Value const& value, std::initializer_list<std::string_view> path);
std::optional<std::string> text_at(Value const& value, std::initializer_list<std::string_view> path);
/// The finite numbers of a list, or nothing where it is no list of numbers.
std::optional<std::vector<double>> numbers_at(Value const& value,
                                              std::initializer_list<std::string_view> path);

/// The entries of a table under their keys, or those of a list of tables under what they call themselves
/// (`name`, `wavelength_nm`, `source`, `object`, else their number).
std::vector<std::pair<std::string, Value const*>> entries_at(Value const& value, std::string_view key);

/// Escaped HTML for a number, a list of numbers "(1, 2, 3)", a text or a truth; an en dash where there is
/// none. Parts of a list that are smaller than any length or direction can mean are 0.
std::string shown(Value const* value);

/// <table> with a heading row. Cells are HTML already; columns after the first are set as figures.
struct HtmlTable {
    std::vector<std::string> headings;
    std::vector<std::vector<std::string>> rows;
};
std::string html_of(HtmlTable const& table);

} // namespace sahl::report

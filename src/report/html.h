// In: texts and coordinates. Out: pieces of HTML and SVG. Text from a file passes through `escaped` on its
// way to the page, or is data (json_text.h).
#pragma once

#include <string>
#include <string_view>

namespace sahl::report {

/// The same text where HTML expects text or a quoted attribute: &, <, >, both quotes as entities, control
/// characters (which HTML forbids) as U+FFFD.
std::string escaped(std::string_view text);

/// A coordinate in a drawing: two decimals at most, no −0.
std::string coordinate(double pixels);

} // namespace sahl::report

// In: nothing. Out: the style sheet of the page, for light and dark screens and for paper.
#pragma once

#include <string_view>

namespace sahl::report {

extern std::string_view const style_sheet;

} // namespace sahl::report

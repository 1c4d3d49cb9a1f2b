// In: nothing. Out: the page without its title and data, as scripts/web bundles it of report/web/. CMake
// makes the text of web_page.cpp of it, so that the program needs no file beside it.
#pragma once

#include <string>

namespace sahl::report {

/// "@TITLE@" and "@DATA@" stand where those belong, once each.
std::string web_page();

} // namespace sahl::report

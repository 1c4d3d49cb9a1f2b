// In: the rows of a sweep. Out: for each detector a chart of its power against the key's value, and a table.
#pragma once

#include "report/page.h"

#include <string>

namespace sahl::report {

/// The unit that a key's suffix names, as a person writes it: "object.prism.turn_deg[2]" is in °. Empty if
/// none.
std::string unit_of_key(std::string_view key);

/// Empty without a sweep.
std::string sweep_html(PageInput const& input);

} // namespace sahl::report

// In: the paths of a log, in groups. Out: them as a tree of values, and as lines to read.
#pragma once

#include "record/path_groups.h"
#include "scene/value.h"

namespace sahl {

Value paths_value(PathGroups const& found, LogHeader const& header);
std::string paths_text(PathGroups const& found);

} // namespace sahl

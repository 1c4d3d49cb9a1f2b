// In: a scene, and the filters that its experiment writes of the log and of detectors. Out: those filters,
// ready to select paths.
#pragma once

#include "scene/scene.h"
#include "trace/path_filter.h"

#include <optional>
#include <vector>

namespace sahl {

/// Which paths are logged, and by detector which count; none: all.
struct PathFilters {
    std::optional<PathFilter> log;
    std::vector<std::optional<PathFilter>> detectors;
    bool at_detectors = false; // at least one has a filter
};

/// Those of the scene's detectors and the log's. Throws InputError where one is wrong.
PathFilters path_filters(Scene const& scene, WrittenFilter const& log);

} // namespace sahl

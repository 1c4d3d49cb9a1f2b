// In: a ray log, and perhaps the experiment it came from. Out: its rays as coloured lines beside the bodies,
// as a model file.
#pragma once

#include "record/ray_log.h"
#include "run/ray_colours.h"
#include "run/run.h"
#include "trace/path_filter.h"

#include <filesystem>
#include <optional>

namespace sahl {

/// .glb: every segment as a line, in metres, its colour at both ends: the hue of its wavelength; its power at
/// the start and at the end, on a scale of six decades below the greatest; or how many interactions it has
/// behind it. What escapes is drawn a quarter as long as all the rest is wide.
///   bodies   the experiment whose bodies, and rectangles of detectors, stand beside them; none: rays alone
///   turn     of exact shapes: see geometry/tessellate.h
///   where    only the paths that it selects; or null
/// Throws InputError.
void export_rays_glb(RayLogReader const& log, std::optional<ExperimentSource> const& bodies, unsigned turn,
                     ColourBy by, std::filesystem::path const& out, PathFilter const* where = nullptr);

} // namespace sahl

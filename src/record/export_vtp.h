// In: a ray log. Out: its pieces as lines with their values, for ParaView and other programs of VTK.
#pragma once

#include "record/ray_log.h"
#include "trace/path_filter.h"

#include <filesystem>

namespace sahl {

/// VTK XML PolyData (.vtp): a line a segment, places in mm, and for each line the log's columns but those of
/// place and length, which the lines have; events, surfaces and media as numbers. Numbers are those of the
/// log, unrounded, in raw appended blocks. What escapes is drawn a quarter as long as all the rest is wide.
/// The log is read once for each column, so that it need not fit into memory.
///   where   only the paths that it selects; or null
void export_vtp(RayLogReader const& log, std::filesystem::path const& out, PathFilter const* where = nullptr);

} // namespace sahl

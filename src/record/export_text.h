// In: a ray log. Out: its rows in two other layouts of text.
#pragma once

#include "record/ray_log.h"
#include "trace/path_filter.h"

#include <filesystem>

namespace sahl {

/// JSON Lines: one object a segment, its keys the log's columns in their order, then "end_mm". Events,
/// surfaces and media by name, numbers the shortest that read back to the same double; what has no number
/// (the length of an escape, its optical path and end, a surface that is not met) is null.
///   where   only the paths that it selects; or null
void export_json_lines(RayLogReader const& log, std::filesystem::path const& out,
                       PathFilter const* where = nullptr);

/// The column layout of SolTrace's ray data: Pos X, Pos Y, Pos Z, Cos X, Cos Y, Cos Z, Element, Stage, Ray
/// Number. One row for each place where a piece of path ends: the place in m, in the world; the direction in
/// which light arrives; the face's number from 1 on, negative where it ends there for good; stage 1; the
/// ray's number from 1 on. What ends on no face, escapes and branches that were cut, has no row.
void export_soltrace(RayLogReader const& log, std::filesystem::path const& out,
                     PathFilter const* where = nullptr);

} // namespace sahl

// In: a ray log. Out: the same rows as text, one line a segment.
#pragma once

#include "record/ray_log.h"
#include "trace/path_filter.h"

#include <filesystem>

namespace sahl {

/// Writes the log's columns in their order, then end_x_mm, end_y_mm, end_z_mm, under a header line: events,
/// surfaces and media by name, numbers with 17 digits, so that they read back as the same doubles. Where a
/// segment ends on nothing `surface` is empty; where it escapes its length is inf and its end is empty. Names
/// with a comma, a quote or a line break stand in double quotes (RFC 4180). `out` appears when it is
/// complete; it is an InputError if it cannot be written.
///   where   only the paths that it selects; or null
void export_csv(RayLogReader const& log, std::filesystem::path const& out, PathFilter const* where = nullptr);

} // namespace sahl

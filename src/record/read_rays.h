// In: a ray log, and perhaps a path filter. Out: its rays, one after another.
#pragma once

#include "record/ray_log.h"
#include "trace/path_filter.h"

#include <functional>
#include <optional>

namespace sahl {

/// What a filter may name in a log.
FilterNames filter_names(LogHeader const& header);

/// A filter for a log; none where the text selects everything. Throws InputError that points at what is
/// wrong.
///   place   where the text comes from: "--where"
std::optional<PathFilter> log_filter(LogHeader const& header, std::string const& text,
                                     std::string const& place);

/// Of all rows of one ray those of the paths that a filter selects.
std::vector<Segment> selected_rows(std::span<Segment const> ray, PathFilter const& where);

/// Calls `take` with the rows of each ray in turn, of which a filter leaves those of the paths that it
/// selects; rays of which it leaves nothing are passed over. Memory is that of a portion and the largest ray.
/// `take` returns whether to go on.
void read_rays(RayLogReader const& log, PathFilter const* where,
               std::function<bool(std::span<Segment const> ray)> const& take);

} // namespace sahl

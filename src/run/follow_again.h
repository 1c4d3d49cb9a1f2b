// In: rays that were traced. Out: how differently some of them fare with other draws.
#pragma once

#include "record/detector.h"
#include "trace/tracer.h"

#include <span>
#include <vector>

namespace sahl {

/// Is anything drawn on a ray's way: the branch it takes, or where a Lambertian surface sends it?
bool left_to_chance(Scene const& scene, TraceOptions const& options);

/// Follows rays of [first, first + count) a second time: all of a short run, one of up to 16 of a long one.
///   hits   of the first time, by ray
/// Returns sums for each detector.
std::vector<TwiceSums> follow_again(TraceContext const& context, std::uint64_t first, std::uint64_t count,
                                    std::span<DetectorHit const> hits);

} // namespace sahl

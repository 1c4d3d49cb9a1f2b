#include "trace/tracer.h"

#include "trace/grove.h"

#include <algorithm>

namespace sahl {

namespace {

/// Rays whose trees grow together, generation by generation: few enough that their branches stay in the
/// cache, which many do where each has but one branch.
constexpr std::uint32_t rays_together = 32;
/// Where that is so, and of a picture, whose rays go much the same way: the more there are, the more of a
/// mesh's tree is in the cache for the next (measured with 102 400 triangles: a tenth of a next hit's time).
constexpr std::uint32_t paths_together = 256;

} // namespace

BatchResult trace_batch(TraceContext const& context, std::uint64_t first, std::uint64_t count,
                        SegmentSink* sink) {
    BatchResult result{Tally(context.unit, context.scene.bodies.size(), context.scene.faces.size(),
                             context.optics.wavelengths().size()),
                       {},
                       {},
                       {},
                       {}};
    Grove grove(context, result, sink != nullptr ? *sink : result.log);
    std::uint32_t const group = one_path_a_ray(context.options) ? paths_together : rays_together;
    for (std::uint64_t done = 0; done < count; done += group)
        grove.grow(first + done, static_cast<std::uint32_t>(std::min<std::uint64_t>(group, count - done)));
    return result;
}

std::array<std::uint64_t, event_names.size()> trace_rays(TraceContext const& context, std::uint64_t first,
                                                         std::span<Ray const> rays, TreeWatch& watch,
                                                         Bvh::Start const* start) {
    BatchResult result{Tally(context.unit, 0, 0, 0), {}, {}, {}, {}};
    Grove grove(context, result, result.log);
    grove.watch(watch, start);
    for (std::size_t done = 0; done < rays.size(); done += paths_together)
        grove.grow(first + done,
                   rays.subspan(done, std::min<std::size_t>(paths_together, rays.size() - done)));
    return result.tally.ended;
}

} // namespace sahl

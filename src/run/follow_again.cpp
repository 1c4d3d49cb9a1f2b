#include "run/follow_again.h"

#include "math/random.h"

#include <algorithm>

namespace sahl {

namespace {

// A few thousand rays tell how much is chance to a few percent; of long runs one ray in so many costs little.
constexpr std::uint64_t enough_rays = 4096, longest_stride = 16;

/// Takes the hits of one ray from the front of the list: power by detector.
void take_ray(std::span<DetectorHit const>& hits, std::uint64_t ray, std::vector<double>& power) {
    std::fill(power.begin(), power.end(), 0.0);
    std::size_t next = 0;
    for (; next < hits.size() && hits[next].ray <= ray; ++next)
        if (hits[next].ray == ray)
            power[hits[next].detector.value] += hits[next].power;
    hits = hits.subspan(next);
}

} // namespace

bool left_to_chance(Scene const& scene, TraceOptions const& options) {
    return options.branch == BranchPolicy::roulette ||
           std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                       [](Surface const& s) { return std::holds_alternative<Diffuse>(s.kind); });
}

std::vector<TwiceSums> follow_again(TraceContext const& context, std::uint64_t first, std::uint64_t count,
                                    std::span<DetectorHit const> hits) {
    std::uint64_t const stride =
        std::clamp(context.emission.rays() / enough_rays, std::uint64_t{1}, longest_stride);
    std::vector<TwiceSums> sums(context.scene.detectors.size());
    std::vector<double> once(sums.size()), again(sums.size());
    TraceContext second = context;
    second.log_every = 0;
    second.again = true;
    for (std::uint64_t start = first; start < first + count; start += stride) {
        std::uint64_t const among = std::min(stride, first + count - start);
        std::uint64_t const ray = start + mix64(start) % among; // not in step with a pattern's rows
        BatchResult const result = trace_batch(second, ray, 1);
        std::span<DetectorHit const> hits_again = result.hits;
        take_ray(hits, ray, once);
        take_ray(hits_again, ray, again);
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i].add(once[i], again[i], context.unit);
    }
    return sums;
}

} // namespace sahl

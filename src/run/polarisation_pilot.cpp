#include "run/polarisation_pilot.h"

#include "run/path_errors.h"
#include "run/trace_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace sahl {

namespace {

constexpr std::uint64_t most_pilots = 4096, pilots_of_a_source = 256, fewest_of_a_source = 16;

/// Powers by what they arrive at, in a fixed order.
using Powers = std::map<std::string, double>;

void add_detected(Powers& powers, Scene const& scene, BatchResult const& result, double weight) {
    for (DetectorHit const& hit : result.hits)
        powers["detector " + scene.detectors[hit.detector.value].name] += weight * hit.power;
}

void add_lost(Powers& powers, Scene const& scene, BatchResult const& result, double weight) {
    Tally const& tally = result.tally;
    auto const add = [&](std::string const& what, ExactSum const& sum) {
        if (sum != ExactSum{})
            powers[what] += weight * sum.value(tally.unit);
    };
    for (std::size_t face = 0; face < scene.faces.size(); ++face)
        add("light that is absorbed at " + scene.faces[face].name, tally.absorbed_at_face[face]);
    for (std::size_t body = 0; body < scene.bodies.size(); ++body)
        add("light that is absorbed in " + scene.bodies[body].name, tally.absorbed_in_body[body]);
    std::vector<Segment> const& tree = result.log.segments;
    for (Segment const& segment : tree)
        if (segment.ended == Event::escaped && segment.parent >= 0) {
            auto const face =
                static_cast<std::size_t>(tree[static_cast<std::size_t>(segment.parent)].surface);
            powers["light that escapes " + std::string(name_of(segment.born)) + " at " +
                   scene.faces[face].name] += weight * segment.power_end;
        }
}

} // namespace

std::vector<PolarisationMove> polarisation_moves(Scene const& scene, WavelengthTable const& optics,
                                                 Emission const& emission, TraceOptions const& options) {
    if (emission.rays() == 0)
        return {};
    TraceOptions split = options;
    split.branch = BranchPolicy::split;
    // roulette may go down to branches that are too many to split; below the tolerance they move little
    split.min_power = std::max(options.min_power, 0.1 * options.tolerance_power);
    PathFilters const filters = path_filters(scene, {});
    TraceContext mean{scene, optics, emission, split, power_unit(emission), 1};
    mean.filters = filters.at_detectors ? &filters : nullptr;
    TraceContext apart = mean;
    apart.polarised = true;

    auto const& first = emission.first_rays();
    std::uint64_t const each = std::clamp(most_pilots / std::max<std::uint64_t>(1, first.size() - 1),
                                          fewest_of_a_source, pilots_of_a_source);
    Powers as_traced, kept_apart;
    auto const add = scene.detectors.empty() ? add_lost : add_detected;
    std::size_t source = 0;
    for (std::uint64_t const ray : spread_rays(emission, each, 0.5)) {
        while (ray >= first[source + 1])
            ++source;
        std::uint64_t const all = first[source + 1] - first[source];
        double const weight = static_cast<double>(all) / static_cast<double>(std::min(all, each));
        add(as_traced, scene, trace_batch(mean, ray, 1), weight);
        add(kept_apart, scene, trace_batch(apart, ray, 1), weight);
    }
    for (auto const& [what, power] : kept_apart)
        as_traced.try_emplace(what, 0.0);
    std::vector<PolarisationMove> moves;
    for (auto const& [what, power] : as_traced) {
        auto const found = kept_apart.find(what);
        double const other = found != kept_apart.end() ? found->second : 0.0;
        double const whole = scene.detectors.empty() ? emission.power() : power;
        moves.push_back({what, power, other, whole > 0.0 ? (other - power) / whole : 0.0});
    }
    return moves;
}

std::vector<std::string> polarisation_warnings(std::vector<PolarisationMove> const& moves, double tolerance) {
    std::vector<std::string> warnings;
    for (PolarisationMove const& move : moves)
        if (std::abs(move.share) > tolerance) {
            char text[300];
            std::snprintf(
                text, sizeof text,
                ": with s and p kept apart its power would %s by about %.2g %%%s (tolerance_power is "
                "%.2g %%); this version takes their mean at each surface",
                move.share > 0.0 ? "rise" : "fall", 100.0 * std::abs(move.share),
                move.what.starts_with("detector") ? "" : " of what is emitted", 100.0 * tolerance);
            warnings.push_back(move.what + text);
        }
    return warnings;
}

} // namespace sahl

#include "run/polarisation_pilot.h"

#include "optics/snell.h"
#include "run/trace_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sahl {

namespace {

constexpr std::uint64_t pilot_rays = 256;

/// What s and p carry beyond their mean share: 1 and 1 for light that no surface has sorted.
struct Weights {
    double s = 1.0, p = 1.0;
};

Weights times(Weights const& weights, double share_s, double share_p) {
    double const mean = 0.5 * (share_s + share_p);
    return mean > 0.0 ? Weights{weights.s * share_s / mean, weights.p * share_p / mean} : weights;
}

/// The weights of a child, from its parent's and from what the surface between them does to s and p.
Weights passed_on(Scene const& scene, WavelengthTable const& optics, WavelengthId wavelength,
                  Segment const& parent, Segment const& child, Segment const* through,
                  Weights const& weights) {
    if (parent.surface < 0 || (child.born != Event::refracted && child.born != Event::reflected))
        return weights;
    auto const& surface = scene.faces[static_cast<std::size_t>(parent.surface)].surface;
    double const n = optics.index({parent.medium}, wavelength);
    bool const boundary = !surface || std::holds_alternative<Tinted>(scene.surfaces[surface->value].kind);
    if (boundary && through) {
        double const n_through = optics.index({through->medium}, wavelength);
        dvec3 const step =
            n * parent.direction - n_through * through->direction; // along the normal, by Snell
        double const size = length(step);
        if (size == 0.0)
            return weights;
        dvec3 const normal = step * ((dot(step, parent.direction) > 0.0 ? -1.0 : 1.0) / size);
        auto const shares = fresnel_dielectric(Approach(parent.direction, normal).incidence, n, n_through);
        if (!shares)
            return weights;
        return child.born == Event::refracted ? times(weights, shares->t_s, shares->t_p)
                                              : times(weights, shares->r_s, shares->r_p);
    }
    if (surface && std::holds_alternative<Metal>(scene.surfaces[surface->value].kind)) {
        dvec3 const normal = normalize(child.direction - parent.direction);
        FresnelShares const shares = fresnel_metal(Approach(parent.direction, normal).incidence, n,
                                                   optics.metal(*surface, wavelength));
        return times(weights, shares.r_s, shares.r_p);
    }
    return weights;
}

} // namespace

std::vector<double> polarisation_shift(Scene const& scene, WavelengthTable const& optics,
                                       Emission const& emission, TraceOptions const& options) {
    TraceOptions split = options;
    split.branch = BranchPolicy::split;
    // roulette may go down to branches that are too many to split; below the tolerance they move little
    split.min_power = std::max(options.min_power, 0.1 * options.tolerance_power);
    TraceContext const context{scene, optics, emission, split, power_unit(emission), 1};
    std::vector<double> mean(scene.detectors.size()), apart(scene.detectors.size());
    std::uint64_t const rays = std::min(pilot_rays, emission.rays());
    for (std::uint64_t i = 0; i < rays; ++i) {
        std::vector<Segment> const tree = trace_batch(context, emission.rays() * i / rays, 1).log.segments;
        std::vector<Segment const*> through(tree.size(), nullptr); // by parent: the branch that was refracted
        for (Segment const& segment : tree)
            if (segment.born == Event::refracted)
                through[static_cast<std::size_t>(segment.parent)] = &segment;
        std::vector<Weights> weights(tree.size());
        for (std::size_t row = 0; row < tree.size(); ++row) {
            Segment const& segment = tree[row];
            if (segment.parent >= 0) {
                auto const parent = static_cast<std::size_t>(segment.parent);
                weights[row] = passed_on(scene, optics, optics.id_of(segment.wavelength), tree[parent],
                                         segment, through[parent], weights[parent]);
            }
            if (segment.ended != Event::detected && segment.ended != Event::passed)
                continue;
            Face const& face = scene.faces[static_cast<std::size_t>(segment.surface)];
            auto const detector = scene.bodies[face.body.value].detector->value;
            mean[detector] += segment.power_end;
            apart[detector] += segment.power_end * 0.5 * (weights[row].s + weights[row].p);
        }
    }
    std::vector<double> shift;
    for (std::size_t d = 0; d < mean.size(); ++d)
        shift.push_back(mean[d] > 0.0 ? std::abs(apart[d] - mean[d]) / mean[d] : 0.0);
    return shift;
}

std::vector<std::string> polarisation_warnings(Scene const& scene, WavelengthTable const& optics,
                                               Emission const& emission, TraceOptions const& options) {
    std::vector<std::string> warnings;
    std::vector<double> const shift = polarisation_shift(scene, optics, emission, options);
    for (std::size_t d = 0; d < shift.size(); ++d)
        if (shift[d] > options.tolerance_power) {
            char text[240];
            std::snprintf(text, sizeof text,
                          "detector %s: with s and p kept apart its power would move by about %.2g %% "
                          "(tolerance_power is "
                          "%.2g %%); this version takes their mean at each surface",
                          scene.detectors[d].name.c_str(), 100.0 * shift[d], 100.0 * options.tolerance_power);
            warnings.emplace_back(text);
        }
    return warnings;
}

} // namespace sahl

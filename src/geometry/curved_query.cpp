#include "geometry/curved_query.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sahl {

namespace {

/// Weights: what lies beside a patch by no more than rounding is on it.
constexpr double overlap = 1e-10;

} // namespace

/// On the patch that was proposed, or where the line passes it, on the next one over that side.
bool CurvedQuery::meet(Proposed const& proposed, CurvedCrossing& crossing) const {
    dvec3 const start = origin_ + proposed.t * direction_;
    std::uint32_t triangle = proposed.triangle;
    constexpr int most_steps = 4;
    for (int step = 0; step < most_steps; ++step) {
        Patch const& patch = tree_.patch(triangle);
        auto const met = meet_steeply(patch, start, direction_, tree_.thickness_, 0.25 * rounding_);
        if (!met)
            return false;
        std::array<double, 3> const weights{1.0 - met->v - met->w, met->v, met->w};
        auto const least =
            static_cast<std::size_t>(std::min_element(weights.begin(), weights.end()) - weights.begin());
        if (weights[least] < -overlap) {
            triangle = tree_.fans().triangles[triangle].beside[least];
            if (triangle == SmoothTriangle::none)
                return false;
            continue;
        }
        crossing.t = proposed.t + met->t;
        crossing.point = start + met->t * direction_;
        crossing.geometric = normalize(met->outward);
        crossing.normal = normalize(light_normal(patch, met->v, met->w));
        double const along = dot(crossing.geometric, direction_);
        crossing.slope = std::abs(along);
        crossing.uv = {met->v, met->w};
        crossing.triangle = triangle;
        crossing.enters = along < 0.0;
        return !tree_.lies_beside(crossing, length(direction_), rounding_);
    }
    return false;
}

bool CurvedQuery::settle(double to, CurvedAnswer& answer) const {
    CurvedCrossing best;
    best.t = INFINITY;
    for (Proposed const& proposed : proposals_) {
        if (proposed.t - 2.0 * near_ > best.t)
            continue;
        CurvedCrossing met;
        if (!meet(proposed, met) || met.enters == inside_[tree_.mesh().shell_of(met.triangle)])
            return false;
        if ((met.t - from_) * met.slope < -rounding_) // behind the start
            continue;
        if (std::pair(met.t, met.triangle) < std::pair(best.t, best.triangle))
            best = met;
    }
    bool const nothing = best.t == INFINITY;
    if (nothing ? in_some_ || doubt_ < INFINITY : doubt_ <= best.t + 2.0 * near_)
        return false;
    if (!nothing && best.t <= to)
        answer.crossing = best;
    return true;
}

} // namespace sahl

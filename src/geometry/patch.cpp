#include "geometry/patch.h"

#include <cmath>

namespace sahl {

std::optional<PatchMeeting> meet_steeply(Patch const& patch, dvec3 const& origin, dvec3 const& direction,
                                         double size, double error) {
    constexpr double far = 4.0;     // weights; the patch tells nothing there
    constexpr double enough = 1e-6; // weights: the tangents are those of the place
    // a surface that rises by `size` in the middle lies 4 size · step² off its tangent plane
    double const enough_squared = std::min(enough * enough, error / (4.0 * size));
    PatchMeeting at;
    PatchPoint point{patch.corner - origin, patch.to_second, patch.to_third};
    for (int pass = 0; pass < 8; ++pass) {
        at.outward = point.outward();
        // onto the tangent plane, and there by the tangents
        at.t = dot(at.outward, point.place) / dot(at.outward, direction);
        dvec3 const off = at.t * direction - point.place;
        double const by = 1.0 / dot(at.outward, at.outward);
        double const dv = dot(cross(off, point.by_w), at.outward) * by,
                     dw = dot(cross(point.by_v, off), at.outward) * by;
        at.v += dv;
        at.w += dw;
        if (!(std::abs(at.v) + std::abs(at.w) < far))
            return std::nullopt;
        if (pass > 0 && dv * dv + dw * dw <= enough_squared)
            return at;
        point = point_on(patch, at.v, at.w);
        point.place -= origin;
    }
    return std::nullopt;
}

} // namespace sahl

#include "geometry/patch.h"

#include <cmath>

namespace sahl {

std::optional<PatchMeeting> meet_steeply(Patch const& patch, dvec3 const& origin, dvec3 const& direction) {
    // weights: an error far below what separates two cells
    constexpr double enough = 1e-14;
    constexpr double far = 4.0; // weights; the patch tells nothing there
    dvec3 const start = patch.corner - origin;
    PatchMeeting at;
    PatchPoint point{start, patch.to_second, patch.to_third};
    double last = 0.0;
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
        double const step = std::abs(dv) + std::abs(dw);
        if (!(std::abs(at.v) + std::abs(at.w) < far))
            return std::nullopt;
        // each step's error is that of the last one squared, times what two steps tell
        if (pass > 0 && (step <= enough || step * step * step <= enough * last * last))
            return at;
        last = step;
        point = point_on(patch, at.v, at.w);
        point.place -= origin;
    }
    return last <= 1e-9 ? std::optional(at) : std::nullopt;
}

} // namespace sahl

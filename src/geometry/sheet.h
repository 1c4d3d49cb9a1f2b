// In: an open exact shape and a ray in the shape's own frame. Out: where the ray meets it. All lie in z = 0.
#pragma once

#include "geometry/shape.h"

#include <cmath>
#include <optional>

namespace sahl {

/// Is (x, y) on the sheet? Its border belongs to it.
inline bool covers(Shape const& sheet, double x, double y) { // a visit would be a call through a table
    if (auto const* const rectangle = std::get_if<Rectangle>(&sheet))
        return std::abs(x) <= 0.5 * rectangle->size.x && std::abs(y) <= 0.5 * rectangle->size.y;
    if (auto const* const disk = std::get_if<Disk>(&sheet)) {
        double const squared = x * x + y * y;
        return squared <= disk->radius * disk->radius && squared >= disk->hole_radius * disk->hole_radius;
    }
    return std::holds_alternative<Plane>(sheet);
}

/// t of the meeting, of either sign; empty where the ray runs along the sheet or past it.
inline std::optional<double> meet(Shape const& sheet, dvec3 const& origin, dvec3 const& direction) {
    if (direction.z == 0.0)
        return std::nullopt;
    double const t = -origin.z / direction.z;
    return covers(sheet, origin.x + t * direction.x, origin.y + t * direction.y) ? std::optional(t)
                                                                                 : std::nullopt;
}

} // namespace sahl

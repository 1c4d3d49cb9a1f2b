// In: a triangle's corners. Out: what is asked of one triangle alone.
#pragma once

#include "math/products.h"

#include <algorithm>
#include <array>

namespace sahl {

using TriangleCorners = std::array<dvec3, 3>;

/// Unit; anticlockwise seen from its tip.
inline dvec3 normal_of(TriangleCorners const& corners) {
    auto const& [a, b, c] = corners;
    return normalize(precise_cross(b - a, c - a));
}

/// The point of the triangle's plane below `point`; if it lies outside the triangle, where rounding may put
/// it at grazing incidence, one of the border.
inline dvec3 onto_triangle(TriangleCorners const& corners, dvec3 const& point) {
    dvec3 const& a = corners[0];
    dvec3 const ab = corners[1] - a, ac = corners[2] - a;
    dvec3 const normal = precise_cross(ab, ac), from = point - a;
    double const squared = dot(normal, normal);
    double const v = dot(cross(from, ac), normal) / squared, w = dot(cross(ab, from), normal) / squared;
    if (v >= 0.0 && w >= 0.0 && v + w <= 1.0)
        return point - dot(normal, from) / squared * normal;
    double const v_in = std::max(v, 0.0), w_in = std::max(w, 0.0), sum = std::max(v_in + w_in, 1.0);
    return a + (v_in * ab + w_in * ac) / sum;
}

} // namespace sahl

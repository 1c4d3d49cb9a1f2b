// In: a quadric, or a box, and a line. Out: the stretches of the line that lie in it.
#pragma once

#include "geometry/shape.h"
#include "math/vec.h"

#include <cmath>

namespace sahl {

/// pᵀ A p + b·p + c, A symmetric.
struct Quadric {
    dmat3 a{0.0};
    dvec3 b{0.0};
    double c = 0.0;
    dvec3 middle{0.0}; // of the part that is looked at

    double value(dvec3 const& p) const { return dot(p, a * p) + dot(b, p) + c; }
    dvec3 gradient(dvec3 const& p) const { return 2.0 * (a * p) + b; }
};

inline Quadric quadric_of(QuadricBody const& body) {
    auto const& k = body.coefficients;
    return {dmat3(k[0], 0.5 * k[3], 0.5 * k[4], 0.5 * k[3], k[1], 0.5 * k[5], 0.5 * k[4], 0.5 * k[5], k[2]),
            dvec3(k[6], k[7], k[8]), k[9], dvec3(0.0)};
}

/// x² + y² − m² z², z from the apex; m = change of radius over length.
inline Quadric cone_quadric(double m, double middle) {
    Quadric cone;
    cone.a = dmat3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -m * m);
    cone.middle.z = middle;
    return cone;
}

/// The roots of a quadric along a line, t₁ ≤ t₂; ∓∞ where there is one alone. With none, `inside` holds all
/// along.
struct QuadricRoots {
    double one = -INFINITY, two = INFINITY;
    bool any = false;
    bool between = true; // negative between the roots (beyond −∞, ∞: everywhere), else outside them
    bool everywhere = false;
};

/// An origin that is no farther than `rounding` (m) from the surface is on it.
inline QuadricRoots roots_of(Quadric const& q, dvec3 const& origin, dvec3 const& direction, double rounding) {
    double const at_origin = q.value(origin);
    dvec3 const gradient = q.gradient(origin);
    bool const on = std::abs(at_origin) <= rounding * length(gradient);
    // from the point nearest to the middle, which keeps digits, unless the line starts on the surface
    double const shift = on ? 0.0 : -dot(origin - q.middle, direction) / dot(direction, direction);
    dvec3 const base = origin + shift * direction;
    double const alpha = dot(direction, q.a * direction);
    double const beta = 0.5 * dot(q.gradient(base), direction);
    double const gamma = on ? 0.0 : q.value(base);
    QuadricRoots roots;
    if (alpha == 0.0) {
        if (beta == 0.0) {
            roots.everywhere = gamma <= 0.0;
            return roots;
        }
        double const t = shift - 0.5 * gamma / beta;
        roots.any = true;
        (beta > 0.0 ? roots.two : roots.one) = t;
        return roots;
    }
    roots.between = alpha > 0.0;
    double const discriminant = beta * beta - alpha * gamma;
    if (discriminant < 0.0) {
        roots.everywhere = alpha < 0.0;
        return roots;
    }
    double const root = std::sqrt(discriminant), sum = beta > 0.0 ? -beta - root : root - beta;
    double const first = sum / alpha, second = sum == 0.0 ? first : gamma / sum;
    roots.any = true;
    roots.one = shift + std::min(first, second);
    roots.two = shift + std::max(first, second);
    return roots;
}

/// |n·d| where a line crosses a quadric; at an apex, where there is no normal, that of a crossing straight
/// on.
inline double slope_at(Quadric const& q, dvec3 const& point, dvec3 const& direction) {
    dvec3 const gradient = q.gradient(point);
    double const steepness = length(gradient);
    return steepness > 0.0 ? std::abs(dot(gradient, direction)) / steepness : length(direction);
}

/// Moves a point that is on the quadric but for rounding onto it; returns the unit normal, along the
/// gradient.
inline dvec3 settle(Quadric const& q, dvec3& point) {
    for (int pass = 0; pass < 2; ++pass) {
        dvec3 const gradient = q.gradient(point);
        double const squared = dot(gradient, gradient);
        if (!(squared > 0.0))
            return {0.0, 0.0, 1.0}; // an apex
        point -= q.value(point) / squared * gradient;
    }
    dvec3 const gradient = q.gradient(point);
    double const steepness = length(gradient);
    return steepness > 0.0 ? (1.0 / steepness) * gradient : dvec3(0.0, 0.0, 1.0);
}

} // namespace sahl

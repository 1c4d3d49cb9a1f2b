// In: the places and normals round a vertex. Out: the polynomial of degree 4 that the surface is there, by
// least squares over heights and slopes (Hermite data).
#pragma once

#include "geometry/smooth_fans.h"

#include <array>
#include <cstdint>
#include <optional>

namespace sahl {

/// z = f(x, y) in a frame at a fan's place, z along its normal.
struct HeightField {
    dvec3 origin{0.0}, x_axis{0.0}, y_axis{0.0}, z_axis{0.0};
    /// of x, y, xx, xy, yy, xxx, xxy, xyy, yyy, xxxx, xxxy, xxyy, xyyy, yyyy; lengths in m
    std::array<double, 14> c{};
    double constant = 0.0; // m: how far the place itself lies below the surface

    /// Height above the surface along z, and its gradient: > 0 outside.
    double above(dvec3 const& point, dvec3& gradient) const;
};

inline double HeightField::above(dvec3 const& point, dvec3& gradient) const {
    dvec3 const from = point - origin;
    double const x = dot(from, x_axis), y = dot(from, y_axis);
    double const p0 = x * (c[0] + x * (c[2] + x * (c[5] + x * c[9])));
    double const p1 = c[1] + x * (c[3] + x * (c[6] + x * c[10]));
    double const p2 = c[4] + x * (c[7] + x * c[11]), p3 = c[8] + x * c[12];
    double const f = p0 + y * (p1 + y * (p2 + y * (p3 + y * c[13])));
    double const fy = p1 + y * (2.0 * p2 + y * (3.0 * p3 + y * (4.0 * c[13])));
    double const d0 = c[0] + x * (2.0 * c[2] + x * (3.0 * c[5] + x * (4.0 * c[9])));
    double const d1 = c[3] + x * (2.0 * c[6] + x * (3.0 * c[10])), d2 = c[7] + x * (2.0 * c[11]);
    double const fx = d0 + y * (d1 + y * (d2 + y * c[12]));
    gradient = z_axis - fx * x_axis - fy * y_axis;
    return dot(from, z_axis) - f - constant;
}

struct FitOptions {
    int degree = 4;     // 1 … 4; lowered where the data do not carry it
    bool slopes = true; // the fans' normals too, and not their places alone
};

/// From two rings of neighbours, each datum weighted by how far it may be off. Nothing where not even a plane
/// is determined.
std::optional<HeightField> fit_at(SmoothFans const& fans, std::uint32_t fan, FitOptions const& options);

} // namespace sahl

// In: the places and normals round a vertex. Out: the polynomial of degree 5 that the surface is there, by
// least squares over heights and slopes (Hermite data).
#pragma once

#include "geometry/smooth_fans.h"

#include <array>
#include <cstdint>
#include <optional>

namespace sahl {

/// z = f(x, y) in a frame at a fan's place, z along its normal.
struct HeightField {
    static constexpr int degree = 5;
    static constexpr std::size_t terms = 20;
    dvec3 origin{0.0}, x_axis{0.0}, y_axis{0.0}, z_axis{0.0};
    /// of x, y, xx, xy, yy, xxx, … by their degree; lengths in m
    std::array<double, terms> c{};
    double constant = 0.0; // m: how far the place itself lies below the surface

    /// Height above the surface along z, and its gradient: > 0 outside.
    double above(dvec3 const& point, dvec3& gradient) const;
};

inline double HeightField::above(dvec3 const& point, dvec3& gradient) const {
    dvec3 const from = point - origin;
    double const x = dot(from, x_axis), y = dot(from, y_axis);
    // by Horner's rule in y of polynomials in x, each by Horner's rule, and their derivatives
    double f = 0.0, fx = 0.0, fy = 0.0;
    constexpr std::size_t most = degree;
    for (std::size_t j = most + 1; j-- > 0;) {
        double p = 0.0, px = 0.0;
        for (std::size_t i = most - j + 1; i-- > 0;) {
            std::size_t const sum = i + j;
            px = px * x + p;
            p = p * x + (sum == 0 ? 0.0 : c[sum * (sum + 1) / 2 + j - 1]);
        }
        fy = fy * y + f;
        f = f * y + p;
        fx = fx * y + px;
    }
    gradient = z_axis - fx * x_axis - fy * y_axis;
    return dot(from, z_axis) - f - constant;
}

struct FitOptions {
    int degree = HeightField::degree; // 1 … that; lowered where the data do not carry it
    bool slopes = true;               // the fans' normals too, and not their places alone
};

/// From two rings of neighbours or three, each datum weighted by how far it may be off. Nothing where not
/// even a plane is determined.
std::optional<HeightField> fit_at(SmoothFans const& fans, std::uint32_t fan, FitOptions const& options);

} // namespace sahl

// In: a line and a triangle, in double. Out: whether the one passes through the other, and how closely: never
// through none or both of two triangles that share an edge.
#pragma once

#include "geometry/triangle.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace sahl {

/// A line made ready for the watertight test: sheared so that it runs along the third of its permuted axes
/// (S. Woop, C. Benthin, I. Wald, Watertight Ray/Triangle Intersection, JCGT 2 (2013) 65). An edge that two
/// triangles share gives both the same number with the opposite sign, exactly.
struct ShearedLine {
    dvec3 origin, direction;
    int kx, ky, kz;
    double shear_x, shear_y, shear_z;

    ShearedLine(dvec3 const& from, dvec3 const& along) : origin(from), direction(along) {
        dvec3 const size = glm::abs(along);
        kz = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        kx = (kz + 1) % 3;
        ky = (kx + 1) % 3;
        if (along[kz] < 0.0)
            std::swap(kx, ky); // keeps the winding
        shear_x = along[kx] / along[kz];
        shear_y = along[ky] / along[kz];
        shear_z = 1.0 / along[kz];
    }
};

/// Is `c × b` positive for a line moved from (0, 0) by a little in x, and by much less in y? So a line
/// through an edge passes on one side of it, the same for both its triangles, and a line through a vertex
/// through one of them (H. Edelsbrunner, E. P. Mücke, Simulation of Simplicity, ACM Trans. Graph. 9 (1990)
/// 66).
inline bool is_positive(double product, dvec2 const& b, dvec2 const& c) {
    return product != 0.0 ? product > 0.0 : c.y != b.y ? c.y > b.y : b.x > c.x;
}

/// A triangle seen along a line.
struct SeenTriangle {
    std::array<dvec3, 3> corners; // from the line's origin
    std::array<dvec2, 3> flat;    // across the line
    double u, v, w;               // twice the signed areas between the line and each edge

    SeenTriangle(ShearedLine const& line, TriangleCorners const& triangle) {
        for (std::size_t i = 0; i < 3; ++i) {
            corners[i] = triangle[i] - line.origin;
            dvec3 const& p = corners[i];
            flat[i] = {p[line.kx] - line.shear_x * p[line.kz], p[line.ky] - line.shear_y * p[line.kz]};
        }
        auto const& [a, b, c] = flat;
        u = c.x * b.y - c.y * b.x;
        v = a.x * c.y - a.y * c.x;
        w = b.x * a.y - b.y * a.x;
    }
    /// Does the line pass through the triangle, and then into what it bounds? Never through none or both of
    /// two that share an edge.
    std::optional<bool> passed() const {
        auto const& [a, b, c] = flat;
        bool const positive = is_positive(u, b, c);
        if (is_positive(v, c, a) != positive || is_positive(w, a, b) != positive)
            return std::nullopt;
        return positive;
    }
    /// Does the line pass through the triangle seen with this sense (±1), or no farther than `distance` from
    /// it?
    bool near(double sense, double distance) const {
        auto const& [a, b, c] = flat;
        return sense * u >= -distance * length(c - b) && sense * v >= -distance * length(a - c) &&
               sense * w >= -distance * length(b - a);
    }
};

} // namespace sahl

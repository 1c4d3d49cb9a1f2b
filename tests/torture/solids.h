// In: sizes. Out: meshes of the torture suite that tests/support/meshes.h does not have.
#pragma once

#include "support/meshes.h"
#include "torture/scene.h"

#include <vector>

namespace sahl::bench {

inline MeshRef mesh_of(TriangleSoup soup) {
    return std::make_shared<Mesh const>(make_mesh(std::move(soup)));
}

/// A closed body whose outline (r, z) is turned about z in `n` steps; it begins and ends on the axis.
/// Outlines with a piece in common have the same corners there.
inline TriangleSoup revolved(std::vector<dvec2> const& outline, std::uint32_t n, double phase = 0.0) {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    auto const corner = [&](std::size_t i, std::uint32_t k) {
        return outline[i].x == 0.0 ? static_cast<std::uint32_t>(i * n)
                                   : static_cast<std::uint32_t>(i * n) + k % n;
    };
    for (dvec2 const& p : outline)
        for (std::uint32_t k = 0; k < n; ++k) {
            double const a = phase + 2.0 * std::numbers::pi * k / n;
            soup.positions.push_back({p.x * std::cos(a), p.x * std::sin(a), p.y});
        }
    for (std::size_t i = 0; i + 1 < outline.size(); ++i)
        for (std::uint32_t k = 0; k < n; ++k) {
            if (outline[i + 1].x != 0.0)
                add_triangle(soup, corner(i, k), corner(i + 1, k + 1), corner(i + 1, k));
            if (outline[i].x != 0.0)
                add_triangle(soup, corner(i, k), corner(i, k + 1), corner(i + 1, k + 1));
        }
    return soup;
}

/// The part of a lens's surface from the axis to the rim, or back.
inline std::vector<dvec2> arc(double radius, double vertex, double rim, std::uint32_t steps) {
    std::vector<dvec2> points;
    for (std::uint32_t i = 0; i <= steps; ++i) {
        double const h = rim * i / steps;
        double const sag =
            radius == 0.0 ? 0.0 : h * h / (radius * (1.0 + std::sqrt(1.0 - h * h / (radius * radius))));
        points.push_back({h, vertex + sag});
    }
    return points;
}

inline TriangleSoup lens_soup(double r1, double r2, double front, double thickness, double rim,
                              std::uint32_t steps, std::uint32_t around) {
    std::vector<dvec2> outline = arc(r1, front, rim, steps), back = arc(r2, front + thickness, rim, steps);
    outline.insert(outline.end(), back.rbegin(), back.rend());
    return revolved(outline, around);
}

/// A cube from −1 to 1 with n × n squares a face, cut along either diagonal by turns.
inline TriangleSoup grid_box_soup(std::uint32_t n) {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    auto const corner = [&](dvec3 const& p) {
        soup.positions.push_back(p);
        return static_cast<std::uint32_t>(soup.positions.size() - 1);
    };
    for (int axis = 0; axis < 3; ++axis)
        for (double side : {-1.0, 1.0})
            for (std::uint32_t i = 0; i < n; ++i)
                for (std::uint32_t j = 0; j < n; ++j) {
                    std::uint32_t at[4];
                    for (std::uint32_t k = 0; k < 4; ++k) { // counterclockwise seen from outside
                        dvec3 p;
                        p[axis] = side;
                        p[(axis + 1) % 3] = side * (-1.0 + 2.0 * (i + (k == 1 || k == 2)) / n);
                        p[(axis + 2) % 3] = -1.0 + 2.0 * (j + k / 2) / n;
                        at[k] = corner(p);
                    }
                    std::uint32_t const turn = (i + j) % 2;
                    add_triangle(soup, at[turn], at[turn + 1], at[turn + 2]);
                    add_triangle(soup, at[turn], at[turn + 2], at[(turn + 3) % 4]);
                }
    return soup;
}

/// A cube's corner at the origin, closed by the triangle through the ends of its three edges.
inline TriangleSoup corner_soup(double side) {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    soup.positions = {{0, 0, 0}, {side, 0, 0}, {0, side, 0}, {0, 0, side}};
    add_triangle(soup, 0, 2, 1);
    add_triangle(soup, 0, 1, 3);
    add_triangle(soup, 0, 3, 2);
    add_triangle(soup, 1, 2, 3);
    return soup;
}

/// Right-angled, the hypotenuse in the plane x = y (of the given side), as an exact prism of 90° cannot be
/// placed without turning it; length along z.
inline TriangleSoup half_cube(double side, bool upper, double gap, bool other_diagonals) {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    dvec2 const shift = upper ? dvec2(-gap, gap) : dvec2(0.0);
    dvec2 const a = dvec2(0.0) + shift, b = dvec2(side) + shift,
                c = (upper ? dvec2(0.0, side) : dvec2(side, 0.0)) + shift;
    for (double z : {-0.5 * side, 0.5 * side})
        for (dvec2 const& p : {a, b, c})
            soup.positions.push_back({p.x, p.y, z});
    add_triangle(soup, 0, 2, 1);
    add_triangle(soup, 3, 4, 5);
    for (std::uint32_t k = 0; k < 3; ++k) {
        std::uint32_t const n = (k + 1) % 3;
        if (other_diagonals) {
            add_triangle(soup, k, n, n + 3);
            add_triangle(soup, k, n + 3, k + 3);
        } else {
            add_triangle(soup, k, n, k + 3);
            add_triangle(soup, n, n + 3, k + 3);
        }
    }
    return soup;
}

} // namespace sahl::bench

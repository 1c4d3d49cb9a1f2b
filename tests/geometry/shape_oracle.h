// In: a closed shape. Out: whether a point is inside, by its definition in words, apart from src/ on purpose;
// points on its surface, its edges and its corners; and all shapes that the tests walk through.
#pragma once

#include "geometry/shape.h"
#include "math/overloaded.h"
#include "support/dice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace sahl::bench {

/// Height of a lens's surface above its vertex; beyond its radius there is none.
inline double height_of(double radius, double h2) {
    if (radius == 0.0)
        return 0.0;
    double const root = std::sqrt(std::max(0.0, radius * radius - h2));
    return radius > 0.0 ? radius - root : radius + root;
}

/// How far a point at distance h from the axis lies above a lens's surface: the sign from the heights, the
/// size no more than the distance to the sphere, which is what counts where the surface is steep.
inline double above(double radius, double vertex, double h, double limit, double z) {
    double const up = z - vertex - height_of(radius, std::min(h, limit) * std::min(h, limit));
    if (radius == 0.0)
        return up;
    double const off = std::abs(std::hypot(h, z - vertex - radius) - std::abs(radius));
    return std::copysign(std::min(std::abs(up), off), up);
}

/// The same of a conic with even aspheric terms, by its definition.
inline double height_of(double radius, double conic, std::vector<double> const& terms, double h) {
    double const c = radius == 0.0 ? 0.0 : 1.0 / radius;
    double z = c * h * h / (1.0 + std::sqrt(std::max(0.0, 1.0 - (1.0 + conic) * c * c * h * h)));
    for (std::size_t i = 0; i < terms.size(); ++i)
        z += terms[i] * std::pow(h, 4.0 + 2.0 * static_cast<double>(i));
    return z;
}

inline double above(double radius, double conic, std::vector<double> const& terms, double vertex, double h,
                    double limit, double z) {
    if (conic == 0.0 && terms.empty())
        return above(radius, vertex, h, limit, z);
    double const r = std::min(h, limit), step = 1e-6;
    double const steep =
        (height_of(radius, conic, terms, r) - height_of(radius, conic, terms, std::max(0.0, r - step))) /
        step;
    return (z - vertex - height_of(radius, conic, terms, r)) / std::sqrt(1.0 + steep * steep);
}

/// How deep a point lies inside: > 0 inside, < 0 outside, of the order of the distance to the nearest face,
/// in m.
inline double depth(Shape const& shape, dvec3 const& p) {
    double const across = std::sqrt(p.x * p.x + p.y * p.y);
    return std::visit(
        Overloaded{
            [&](Sphere const& s) { return s.radius - length(p); },
            [&](Box const& s) {
                dvec3 const d = 0.5 * s.size - glm::abs(p);
                return std::min({d.x, d.y, d.z});
            },
            [&](Cylinder const& s) { return std::min(s.radius - across, 0.5 * s.length - std::abs(p.z)); },
            [&](Lens const& s) {
                double const h = 0.5 * s.diameter;
                return std::min({h - across, above(s.r1, s.conic1, s.aspheric1, 0.0, across, h, p.z),
                                 -above(s.r2, s.conic2, s.aspheric2, s.thickness, across, h, p.z)});
            },
            [&](Cone const& s) {
                double const share = p.z / s.length + 0.5,
                             radius = s.radius + share * (s.top_radius - s.radius),
                             widening = (s.top_radius - s.radius) / s.length;
                return std::min((radius - across) / std::sqrt(1.0 + widening * widening),
                                0.5 * s.length - std::abs(p.z));
            },
            [&](CornerCube const& s) {
                return std::min({p.x, p.y, p.z, (s.side - p.x - p.y - p.z) / std::sqrt(3.0)});
            },
            [&](QuadricBody const& s) {
                auto const& k = s.coefficients;
                double const value = k[0] * p.x * p.x + k[1] * p.y * p.y + k[2] * p.z * p.z +
                                     k[3] * p.x * p.y + k[4] * p.x * p.z + k[5] * p.y * p.z + k[6] * p.x +
                                     k[7] * p.y + k[8] * p.z + k[9];
                dvec3 const steep(2.0 * k[0] * p.x + k[3] * p.y + k[4] * p.z + k[6],
                                  2.0 * k[1] * p.y + k[3] * p.x + k[5] * p.z + k[7],
                                  2.0 * k[2] * p.z + k[4] * p.x + k[5] * p.y + k[8]);
                dvec3 const d = 0.5 * s.clip - glm::abs(p);
                return std::min({-value / std::max(length(steep), 1e-3), d.x, d.y, d.z});
            },
            [&](Prism const& s) {
                // the triangle's corners, and which side of each of its sides the point is on
                double const x = s.side * std::sin(0.5 * s.apex), y = 0.5 * s.side * std::cos(0.5 * s.apex);
                dvec2 const top(0.0, y), left(-x, -y), right(x, -y), at(p.x, p.y);
                auto const to_side = [&](dvec2 const& a, dvec2 const& b) {
                    dvec2 const e = b - a, d = at - a;
                    return (e.x * d.y - e.y * d.x) / length(e);
                };
                return std::min({to_side(top, left), to_side(left, right), to_side(right, top),
                                 0.5 * s.length - std::abs(p.z)});
            },
            [](auto const&) { return -1.0; },
        },
        shape);
}

/// Planes, balls and tubes, at a size of about a metre.
inline std::vector<std::pair<std::string, Shape>> simple_shapes() {
    double const deg = std::numbers::pi / 180.0;
    return {
        {"sphere", Sphere{1.0}},
        {"box", Box{{1.0, 1.5, 0.7}}},
        {"flat box", Box{{1.0, 1.0, 1e-3}}},
        {"cylinder", Cylinder{0.5, 1.5}},
        {"biconvex lens", Lens{2.0, -3.0, 0.3, 1.0}},
        {"biconcave lens", Lens{-2.0, 3.0, 0.2, 1.0}},
        {"positive meniscus", Lens{1.0, 2.0, 0.4, 1.0}},
        {"negative meniscus", Lens{-1.0, -0.7, 0.4, 1.2}},
        {"plano-convex lens", Lens{0.0, -1.5, 0.3, 1.0}},
        {"plano-concave lens", Lens{-1.5, 0.0, 0.2, 1.0}},
        {"hemisphere", Lens{0.5, 0.0, 0.5, 1.0}},
        {"ball with a rim of no width", Lens{0.5, -0.5, 1.0, 1.0}},
        {"hollow hemisphere", Lens{-0.5, 0.0, 0.2, 1.0}},
        {"rod lens", Lens{0.6, -0.6, 3.0, 1.0}}, // its back is beyond the ball of the front
        {"rod with hollow ends", Lens{-0.6, 0.6, 3.0, 1.0}},
        {"plate", Lens{0.0, 0.0, 0.2, 1.0}},
        {"acute prism", Prism{30.0 * deg, 1.0, 1.0}},
        {"60° prism", Prism{60.0 * deg, 1.0, 1.0}},
        {"right-angled prism", Prism{90.0 * deg, 1.0, 1.0}},
        {"obtuse prism", Prism{140.0 * deg, 1.0, 1.0}},
    };
}

/// Every closed kind, at a size of about a metre.
inline std::vector<std::pair<std::string, Shape>> closed_shapes() {
    std::vector<std::pair<std::string, Shape>> all = simple_shapes();
    std::vector<std::pair<std::string, Shape>> const curved{
        {"corner cube", CornerCube{1.0}},
        {"cone", Cone{0.6, 0.0, 1.2}},
        {"cone on its tip", Cone{0.0, 0.6, 1.2}},
        {"part of a cone", Cone{0.6, 0.3, 0.8}},
        {"nearly a cylinder", Cone{0.5, 0.5 + 1e-9, 1.0}},
        {"paraboloidal lens", Lens{1.0, 0.0, 0.4, 1.0, -1.0}},
        {"hyperboloidal lens", Lens{0.0, -0.6, 0.5, 1.0, 0.0, -2.3}},
        {"ellipsoidal lens", Lens{0.8, -0.8, 0.5, 1.0, -0.43, 0.5}},
        {"hollow hyperboloids", Lens{-0.8, 0.8, 0.2, 1.0, -3.0, -1.5}},
        {"aspheric lens", Lens{1.2, -2.0, 0.5, 1.0, -0.6, 0.0, {-0.3, 0.2, 0.1}, {0.1, -0.4}}},
        {"wavy plate", Lens{0.0, 0.0, 0.5, 1.0, 0.0, 0.0, {4.0, -20.0}, {-6.0, 25.0}}},
        {"ellipsoid", QuadricBody{{1.0, 2.0, 3.0, 0.4, -0.3, 0.2, 0.1, 0.0, 0.05, -0.6}, {4.0, 4.0, 4.0}}},
        {"saddle in a box",
         QuadricBody{{1.0, -1.5, 0.2, 0.0, 0.0, 0.3, 0.0, 0.0, -1.0, -0.1}, {1.0, 1.2, 0.8}}},
        {"hyperboloid of one sheet",
         QuadricBody{{1.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.1}, dvec3(1.6)}},
        {"slab", QuadricBody{{0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.09}, dvec3(1.0)}},
    };
    all.insert(all.end(), curved.begin(), curved.end());
    return all;
}

/// A point deep inside, the middle of the shape.
inline dvec3 middle(Shape const& shape) {
    return std::visit(
        Overloaded{
            [](Lens const& s) { return dvec3(0.0, 0.0, 0.5 * s.thickness); },
            [](CornerCube const& s) { return dvec3(0.2 * s.side); },
            [](Cone const& s) { return dvec3(0.0, 0.0, s.length * (s.radius > s.top_radius ? -0.2 : 0.2)); },
            [](Prism const& s) { return dvec3(0.0, -0.2 * s.side * std::cos(0.5 * s.apex), 0.0); },
            [](auto const&) { return dvec3(0.0); }},
        shape);
}

/// A place where the surface leaves the box, or on the surface where it stays within; by bisection along a
/// line on a side of the box, or from the middle.
inline dvec3 edge_of_quadric(QuadricBody const& s, Dice& dice) {
    QuadricBody endless = s;
    endless.clip = dvec3(1e3);
    for (int attempt = 0; attempt < 100; ++attempt) {
        dvec3 from = 0.5 * s.clip * dvec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)),
              to = -from;
        auto const axis = static_cast<int>(dice.below(3));
        from[axis] = 0.5 * s.clip[axis];
        to[axis] = from[axis];
        if (attempt >= 50) {
            from = dvec3(0.0);
            to = s.clip * dice.direction();
        }
        if ((depth(endless, from) > 0.0) == (depth(endless, to) > 0.0))
            continue;
        for (int k = 0; k < 60; ++k) {
            dvec3 const half = 0.5 * (from + to);
            ((depth(endless, half) > 0.0) == (depth(endless, from) > 0.0) ? from : to) = half;
        }
        return from;
    }
    return {0.0, 0.0, 0.0};
}

/// Points of edges and corners, outside the shape by no more than rounding.
inline dvec3 edge_point(Shape const& shape, Dice& dice) {
    double const azimuth = dice.between(0.0, 2.0 * std::numbers::pi);
    dvec3 const round(std::cos(azimuth), std::sin(azimuth), 0.0);
    return std::visit(
        Overloaded{
            [&](Sphere const& s) { return s.radius * dice.direction(); },
            [&](Box const& s) {
                dvec3 p = 0.5 * s.size * dvec3(dice.sign(), dice.sign(), dice.sign());
                if (dice.below(3)) // a corner else
                    p[static_cast<int>(dice.below(3))] *= dice.uniform();
                return p;
            },
            [&](Cylinder const& s) {
                return s.radius * round + dvec3(0.0, 0.0, 0.5 * dice.sign() * s.length);
            },
            [&](Lens const& s) {
                double const h = 0.5 * s.diameter;
                double const z = dice.below(2) ? height_of(s.r1, s.conic1, s.aspheric1, h)
                                               : s.thickness + height_of(s.r2, s.conic2, s.aspheric2, h);
                return h * round + dvec3(0.0, 0.0, z);
            },
            [&](Cone const& s) {
                bool const top = dice.below(2) == 1;
                return (top ? s.top_radius : s.radius) * round +
                       dvec3(0.0, 0.0, (top ? 0.5 : -0.5) * s.length);
            },
            [&](CornerCube const& s) {
                dvec3 const corners[4] = {
                    {0.0, 0.0, 0.0}, {s.side, 0.0, 0.0}, {0.0, s.side, 0.0}, {0.0, 0.0, s.side}};
                std::uint64_t const one = dice.below(4), other = dice.below(4);
                double const share = dice.uniform();
                return share * corners[one] + (1.0 - share) * corners[other];
            },
            [&](QuadricBody const& s) { return edge_of_quadric(s, dice); },
            [&](Prism const& s) {
                double const x = s.side * std::sin(0.5 * s.apex), y = 0.5 * s.side * std::cos(0.5 * s.apex);
                double const z = 0.5 * s.length * (dice.below(3) ? dice.between(-1.0, 1.0) : dice.sign());
                std::uint64_t const corner = dice.below(3);
                return corner == 0 ? dvec3(0.0, y, z) : dvec3(corner == 1 ? x : -x, -y, z);
            },
            [](auto const&) { return dvec3(0.0); },
        },
        shape);
}

} // namespace sahl::bench

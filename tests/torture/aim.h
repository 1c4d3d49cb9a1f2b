// In: a body and dice. Out: places on it, and rays that go through them.
#pragma once

#include "torture/solids.h"

namespace sahl::bench {

/// A ray from `before` in front of a place, through it.
inline TortureRay through(Affine const& place, dvec3 const& point, dvec3 const& direction, double before) {
    dvec3 const d = normalize(place.vector(direction));
    return {place.point(point) - before * length(place.linear[0]) * d, d};
}

struct OnTriangle {
    dvec3 point, normal;
    std::uint32_t triangle;
};

/// A point of a triangle: any (kind 0), of an edge (1), a corner (2).
inline OnTriangle on_triangle(Mesh const& mesh, Dice& dice, int kind) {
    auto const triangle = static_cast<std::uint32_t>(dice.below(mesh.soup.triangles.size()));
    auto const& [i, j, k] = mesh.soup.triangles[triangle];
    dvec3 const &a = mesh.soup.positions[i], &b = mesh.soup.positions[j], &c = mesh.soup.positions[k];
    double u = kind == 2 ? 0.0 : dice.uniform(), v = kind == 0 ? dice.uniform() : 0.0;
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return {a + u * (b - a) + v * (c - a), normalize(cross(b - a, c - a)), triangle};
}

/// At an angle of `grazing` (rad) to the surface, into it.
inline dvec3 along_surface(dvec3 const& normal, double grazing, Dice& dice) {
    return std::cos(grazing) * perpendicular_to(normal, dice.direction()) - std::sin(grazing) * normal;
}

/// A point of a box: any inside (0), of an edge (1), a corner (2), of a face's diagonal (3).
inline dvec3 of_box(dvec3 const& low, dvec3 const& high, Dice& dice, int kind) {
    if (kind == 0)
        return dice.in_box(low, high);
    dvec3 p = glm::mix(low, high, dvec3(double(dice.below(2)), double(dice.below(2)), double(dice.below(2))));
    int const axis = static_cast<int>(dice.below(3)), next = (axis + 1) % 3;
    double const u = dice.uniform();
    if (kind == 1 || kind == 3)
        p[axis] = low[axis] + u * (high[axis] - low[axis]);
    if (kind == 3) {
        double const v = dice.below(2) ? u : 1.0 - u;
        p[next] = low[next] + v * (high[next] - low[next]);
    }
    return p;
}

} // namespace sahl::bench

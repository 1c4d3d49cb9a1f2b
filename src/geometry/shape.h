// In: nothing. Out: the exact shapes, as plain sizes in metres, in their own frame, axis along z.
// How a ray meets them is geometry/solid.h (closed) and geometry/sheet.h (open).
#pragma once

#include "math/vec.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sahl {

struct Sphere { // face: surface
    double radius;
};
struct Box { // faces: left −x, right, bottom −y, top, back −z, front
    dvec3 size;
};
struct Cylinder { // faces: side, back −z, front
    double radius, length;
};
struct Cone { // or a part of one: radius at −z, top_radius at +z, either may be 0; faces: side, back −z,
              // front
    double radius, top_radius, length;
};
/// The first vertex at the origin, light along +z; a radius is signed as in optics, 0 is a plane.
/// faces: front, back, edge
struct Lens {
    double r1, r2, thickness, diameter;
    double conic1 = 0.0, conic2 = 0.0;
    std::vector<double> aspheric1 = {}, aspheric2 = {}; // coefficients of r⁴ in m⁻³, r⁶ in m⁻⁵, …
};
/// Isosceles: two faces of `side` meet at the apex edge, which runs along z at the top (+y); centred by its
/// bounding box. faces: left −x, right, base, near −z, far
struct Prism {
    double apex; // rad, (0, π)
    double side, length;
};
/// A cube's corner at the origin, its edges of `side` along +x, +y, +z, closed by the triangle through their
/// ends. faces: x, y, z (where that coordinate is 0), front
struct CornerCube {
    double side;
};
/// What lies within the box of size `clip` about the origin where xᵀAx + bᵀx + c ≤ 0, x in m; coefficients of
/// xx, yy, zz, xy, xz, yz, x, y, z, 1. faces: surface, caps (the box's)
struct QuadricBody {
    std::array<double, 10> coefficients;
    dvec3 clip;
};

struct Plane {};   // z = 0, without end; face: surface
struct Rectangle { // z = 0; face: surface
    dvec2 size;
};
struct Disk { // z = 0; face: surface
    double radius, hole_radius = 0.0;
};
/// A conic of revolution with its vertex at the origin; a positive radius: the centre is at +z, 0 is a plane.
/// face: surface
struct ConicMirror {
    double radius, conic, diameter, hole_diameter = 0.0;
};

using Shape = std::variant<Sphere, Box, Cylinder, Lens, Prism, Plane, Rectangle, Disk, Cone, CornerCube,
                           QuadricBody, ConicMirror>;

/// An open shape has no inside, and needs a surface.
bool is_open(Shape const& shape);

/// The shape's faces, in the order of their numbers.
std::span<std::string_view const> face_names(Shape const& shape);

/// Why no such shape exists, and what would, or nothing: sizes must be finite and positive, a lens's surfaces
/// must reach its rim and not cross. Lengths in the text are in mm, key names those of an experiment file.
std::string shape_problem(Shape const& shape);

} // namespace sahl

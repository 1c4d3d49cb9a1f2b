// In: a shape or a mesh, where it stands, and a view. Out: its outline, as a draughtsman would draw it, in
// metres. outline_shape.cpp draws exact shapes, outline_mesh.cpp meshes.
#pragma once

#include "geometry/mesh.h"
#include "geometry/shape.h"
#include "math/vec.h"

#include <optional>
#include <utility>
#include <vector>

namespace sahl::report {

/// An orthographic view: which axes of the world (0 x, 1 y, 2 z) run to the right and up.
struct View {
    int right = 0, up = 1;

    dvec2 operator()(dvec3 const& world) const { return {world[right], world[up]}; }
    dvec3 towards_viewer() const {
        dvec3 a(0.0), b(0.0);
        a[right] = b[up] = 1.0;
        return cross(a, b);
    }
    bool operator==(View const&) const = default;
};

using Polyline = std::vector<dvec2>;

struct Outline {
    std::vector<Polyline> area;  // loops, closed by themselves, filled by the nonzero rule, and drawn
    std::vector<Polyline> lines; // drawn: edges, rims, profiles
    std::optional<std::pair<dvec2, dvec2>> endless; // a plane seen on edge: a point and a direction
};

Outline outline_of(Shape const& shape, Affine const& to_world, View const& view);

/// The silhouette: edges between facets that face different ways, and borders. Besides, creases of more than
/// 30°, the longest 3000 of them.
Outline outline_of(Mesh const& mesh, Affine const& to_world, View const& view);

/// The corners of the box about a shape in its own frame; none of a plane, which has no end.
std::vector<dvec3> box_corners(Shape const& shape);
std::vector<dvec3> box_corners(dvec3 const& low, dvec3 const& high);

} // namespace sahl::report

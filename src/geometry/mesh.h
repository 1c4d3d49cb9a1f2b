// In: triangles as a model file has them. Out: a mesh ready to trace, its shells found, in double, in its own
// frame. geometry/mesh_manifold.cpp is the door to OpenMesh.
#pragma once

#include "math/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sahl {

/// Triangles as read. `normals` is empty or one per vertex (unit).
struct TriangleSoup {
    std::vector<dvec3> positions;
    std::vector<dvec3> normals;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> triangle_face; // which named face of the object; all 0 where it has one
    std::vector<std::string> face_names;      // at least one
    // of each triangle's corners, from the left and from the bottom of a picture, 0 to 1 once over it; empty:
    // no surface takes its colour from one
    std::vector<std::array<vec2, 3>> texture_coordinates{};
};

/// One component. `sign` +1: normals point out of the volume it encloses; −1: into it (a cavity).
struct MeshShell {
    int sign = 1;
    double volume = 0.0; // m³, enclosed
    bool open = false;   // it has a border, and encloses nothing
};

/// A triangle that was left out because its corners lie on a line: no ray can hit it, yet it closes the
/// surface between its neighbours.
struct FlatTriangle {
    std::array<dvec3, 3> corners;
    std::uint32_t shell;
};

struct Mesh {
    TriangleSoup soup; // welded by exact position where normals agree too; degenerate triangles dropped
    std::vector<std::uint32_t> triangle_shell; // index into shells
    std::vector<MeshShell> shells;
    std::vector<FlatTriangle> flat;
    dvec3 low{0.0}, high{0.0}; // bounding box
    // what the health report says
    std::uint64_t boundary_edges = 0; // 0: closed
    std::uint64_t non_manifold_edges = 0;
    std::uint64_t degenerate_triangles = 0; // dropped
    std::uint64_t flipped_triangles = 0;    // turned round so that neighbours agree
    bool closed() const { return boundary_edges == 0 && non_manifold_edges == 0; }
    /// Where there is but one, no place in memory is looked at: a ray pays for each.
    std::uint32_t shell_of(std::uint32_t triangle) const {
        return shells.size() == 1 ? 0 : triangle_shell[triangle];
    }
    std::uint32_t face_of(std::uint32_t triangle) const {
        return soup.face_names.size() == 1 ? 0 : soup.triangle_face[triangle];
    }
};

/// Welds by exact position (−0 = +0), drops triangles without area, orients neighbours alike, finds the
/// components, and makes the outermost component's normals point outwards (a component inside another keeps
/// the orientation it came with: that is what tells a cavity from a body within a body).
Mesh make_mesh(TriangleSoup soup);

/// Those shells of a mesh alone, in the order given; faces keep their numbers.
Mesh part_of(Mesh const& mesh, std::span<std::uint32_t const> shells);

} // namespace sahl

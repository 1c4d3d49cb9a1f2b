// In: a mesh and some of its shells. Out: a mesh of those alone.
#include "geometry/mesh.h"

#include <utility>

namespace sahl {

namespace {

constexpr std::uint32_t none = 0xFFFFFFFFu;

/// Copies the vertices that triangles have, and renumbers the corners.
void take_vertices(TriangleSoup const& from, TriangleSoup& soup) {
    std::vector<std::uint32_t> number(from.positions.size(), none);
    for (auto& triangle : soup.triangles)
        for (std::uint32_t& corner : triangle) {
            std::uint32_t& here = number[corner];
            if (here == none) {
                here = static_cast<std::uint32_t>(soup.positions.size());
                soup.positions.push_back(from.positions[corner]);
                if (!from.normals.empty())
                    soup.normals.push_back(from.normals[corner]);
            }
            corner = here;
        }
}

} // namespace

Mesh part_of(Mesh const& mesh, std::span<std::uint32_t const> shells) {
    Mesh part;
    std::vector<std::uint32_t> number(mesh.shells.size(), none);
    bool any_open = false;
    for (std::uint32_t const shell : shells) {
        number[shell] = static_cast<std::uint32_t>(part.shells.size());
        part.shells.push_back(mesh.shells[shell]);
        any_open = any_open || mesh.shells[shell].open;
    }
    for (std::size_t t = 0; t < mesh.soup.triangles.size(); ++t) {
        std::uint32_t const shell = number[mesh.triangle_shell[t]];
        if (shell == none)
            continue;
        part.soup.triangles.push_back(mesh.soup.triangles[t]);
        part.soup.triangle_face.push_back(mesh.soup.triangle_face[t]);
        if (!mesh.soup.texture_coordinates.empty())
            part.soup.texture_coordinates.push_back(mesh.soup.texture_coordinates[t]);
        part.triangle_shell.push_back(shell);
    }
    for (FlatTriangle const& flat : mesh.flat)
        if (number[flat.shell] != none)
            part.flat.push_back({flat.corners, number[flat.shell]});
    part.soup.face_names = mesh.soup.face_names;
    take_vertices(mesh.soup, part.soup);
    if (!part.soup.positions.empty())
        part.low = part.high = part.soup.positions.front();
    for (dvec3 const& p : part.soup.positions) {
        part.low = glm::min(part.low, p);
        part.high = glm::max(part.high, p);
    }
    // edges are counted for the whole mesh; borders belong to the open shells
    part.boundary_edges = any_open ? mesh.boundary_edges : 0;
    part.non_manifold_edges = mesh.non_manifold_edges;
    return part;
}

} // namespace sahl

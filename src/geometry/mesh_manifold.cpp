// In: triangles. Out: their topology, where they are a manifold whose sides agree.
// The door to OpenMesh.
#include "geometry/mesh_topology.h"

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>

namespace sahl {

std::optional<Topology> topology_of_manifold(std::span<Corners const> triangles, std::size_t places) {
    static bool const quiet = (::omerr().disable(), true); // it prints what it refuses
    (void)quiet;
    std::vector<double> valence(places, 0.0);
    double steps = 0.0; // OpenMesh walks round each corner's vertex: the sum of squares
    for (Corners const& t : triangles)
        for (std::uint32_t const corner : t)
            steps += 2.0 * valence[corner]++ + 1.0;
    if (steps > 100.0 * static_cast<double>(triangles.size()) + 1e6)
        return std::nullopt;

    OpenMesh::TriConnectivity mesh;
    mesh.reserve(places, triangles.size() * 3 / 2, triangles.size());
    for (std::size_t i = 0; i < places; ++i)
        mesh.new_vertex();
    auto const vertex = [](std::uint32_t place) { return OpenMesh::VertexHandle(static_cast<int>(place)); };
    for (Corners const& t : triangles)
        if (!mesh.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])).is_valid())
            return std::nullopt;

    constexpr std::uint32_t none = 0xFFFFFFFFu;
    Topology topology;
    topology.turned.assign(triangles.size(), false);
    topology.component.assign(triangles.size(), none);
    std::vector<std::uint32_t> piece;
    for (std::uint32_t start = 0; start < triangles.size(); ++start) {
        if (topology.component[start] != none)
            continue;
        std::uint32_t const number = static_cast<std::uint32_t>(topology.open.size());
        topology.open.push_back(false);
        topology.component[start] = number;
        piece.assign(1, start);
        while (!piece.empty()) {
            OpenMesh::FaceHandle const face(static_cast<int>(piece.back()));
            piece.pop_back();
            auto side = mesh.halfedge_handle(face);
            for (int i = 0; i < 3; ++i, side = mesh.next_halfedge_handle(side)) {
                auto const across = mesh.opposite_face_handle(side);
                if (!across.is_valid()) {
                    topology.open[number] = true;
                    ++topology.boundary_edges;
                } else if (std::uint32_t const t = static_cast<std::uint32_t>(across.idx());
                           topology.component[t] == none) {
                    topology.component[t] = number;
                    piece.push_back(t);
                }
            }
        }
    }
    return topology;
}

} // namespace sahl

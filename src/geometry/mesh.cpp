// In: triangles as a model file has them. Out: a mesh ready to trace: welded, oriented, its shells found.
#include "geometry/mesh.h"

#include "geometry/mesh_shells.h"
#include "geometry/mesh_topology.h"
#include "geometry/mesh_weld.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace sahl {

namespace {

using Bits = std::array<std::uint64_t, 3>;

Bits bits(dvec3 const& v) {
    return {std::bit_cast<std::uint64_t>(v.x), std::bit_cast<std::uint64_t>(v.y),
            std::bit_cast<std::uint64_t>(v.z)};
}

/// Keeps the triangles for which `keep(number)` holds, with what is told of each.
template <class Keep>
void keep_triangles(TriangleSoup& soup, std::vector<Corners>& corners, Keep const& keep) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        if (!keep(t))
            continue;
        soup.triangles[kept] = soup.triangles[t];
        soup.triangle_face[kept] = soup.triangle_face[t];
        if (!soup.texture_coordinates.empty())
            soup.texture_coordinates[kept] = soup.texture_coordinates[t];
        corners[kept] = corners[t];
        ++kept;
    }
    soup.triangles.resize(kept);
    soup.triangle_face.resize(kept);
    if (!soup.texture_coordinates.empty())
        soup.texture_coordinates.resize(kept);
    corners.resize(kept);
}

/// Vertices of the same position and normal become one; those that no triangle has are left out.
void merge_vertices(TriangleSoup& soup, std::span<std::uint32_t const> place) {
    std::vector<std::uint32_t> used;
    std::vector<std::uint32_t> number(soup.positions.size(), 0xFFFFFFFFu);
    for (auto const& t : soup.triangles)
        for (std::uint32_t const corner : t)
            if (number[corner] == 0xFFFFFFFFu) {
                number[corner] = static_cast<std::uint32_t>(used.size());
                used.push_back(corner);
            }
    auto const key = [&](std::size_t i) {
        Bits const normal = soup.normals.empty() ? Bits{} : bits(soup.normals[used[i]]);
        return std::array<std::uint64_t, 4>{place[used[i]], normal[0], normal[1], normal[2]};
    };
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> const kind = number_kinds(used.size(), key, first);
    for (auto& t : soup.triangles)
        for (std::uint32_t& corner : t)
            corner = kind[number[corner]];
    std::vector<dvec3> positions, normals;
    for (std::uint32_t const i : first) {
        positions.push_back(soup.positions[used[i]]);
        if (!soup.normals.empty())
            normals.push_back(soup.normals[used[i]]);
    }
    soup.positions = std::move(positions);
    soup.normals = std::move(normals);
}

/// Numbers the components that still have triangles, in their order.
void name_shells(Mesh& mesh, Topology const& topology, std::vector<ClosedComponent> const& components) {
    std::vector<std::uint32_t> shell(components.size(), 0xFFFFFFFFu);
    for (std::uint32_t const c : topology.component) {
        if (shell[c] == 0xFFFFFFFFu) {
            shell[c] = static_cast<std::uint32_t>(mesh.shells.size());
            double const volume = components[c].signed_volume;
            mesh.shells.push_back({volume < 0.0 ? -1 : 1, std::abs(volume), topology.open[c]});
        }
        mesh.triangle_shell.push_back(shell[c]);
    }
    std::erase_if(mesh.flat, [&](FlatTriangle& flat) { // until now it named its component
        flat.shell = shell[flat.shell];
        return flat.shell == 0xFFFFFFFFu;
    });
}

} // namespace

Mesh make_mesh(TriangleSoup soup) {
    Mesh mesh;
    for (auto* vectors : {&soup.positions, &soup.normals})
        for (dvec3& v : *vectors)
            v += dvec3(0.0); // −0 becomes +0
    std::vector<std::uint32_t> first;
    auto const place = number_kinds(
        soup.positions.size(), [&](std::size_t i) { return bits(soup.positions[i]); }, first);
    std::vector<dvec3> places;
    for (std::uint32_t const i : first)
        places.push_back(soup.positions[i]);
    std::vector<Corners> corners;
    for (auto const& t : soup.triangles)
        corners.push_back({place[t[0]], place[t[1]], place[t[2]]});

    std::size_t const all = soup.triangles.size();
    keep_triangles(soup, corners, [&](std::size_t t) {
        return corners[t][0] != corners[t][1] && corners[t][1] != corners[t][2] &&
               corners[t][2] != corners[t][0];
    });
    Topology topology = [&] {
        auto manifold = topology_of_manifold(corners, places.size());
        return manifold ? std::move(*manifold) : topology_by_edges(corners);
    }();
    mesh.boundary_edges = topology.boundary_edges;
    mesh.non_manifold_edges = topology.non_manifold_edges;
    auto const turn = [&](std::size_t t) {
        std::swap(corners[t][1], corners[t][2]);
        std::swap(soup.triangles[t][1], soup.triangles[t][2]);
        if (!soup.texture_coordinates.empty())
            std::swap(soup.texture_coordinates[t][1], soup.texture_coordinates[t][2]);
    };
    for (std::size_t t = 0; t < corners.size(); ++t)
        if (topology.turned[t])
            turn(t);
    std::vector<ClosedComponent> components = closed_components(corners, topology, places);
    std::vector<bool> const wrong = outermost_inside_out(components, places);
    for (std::size_t t = 0; t < corners.size(); ++t) {
        if (wrong[topology.component[t]])
            turn(t);
        mesh.flipped_triangles += topology.turned[t] != wrong[topology.component[t]];
    }
    for (std::size_t c = 0; c < components.size(); ++c)
        components[c].signed_volume *= wrong[c] ? -1.0 : 1.0;

    // a triangle whose corners lie on a line closes the surface between its neighbours, but no ray can hit it
    std::size_t kept = 0;
    keep_triangles(soup, corners, [&](std::size_t t) {
        dvec3 const &a = places[corners[t][0]], &b = places[corners[t][1]], &c = places[corners[t][2]];
        bool const area = cross(b - a, c - a) != dvec3(0.0);
        if (area)
            topology.component[kept++] = topology.component[t];
        else
            mesh.flat.push_back({{a, b, c}, topology.component[t]});
        return area;
    });
    topology.component.resize(kept);
    mesh.degenerate_triangles = all - kept;
    name_shells(mesh, topology, components);
    merge_vertices(soup, place);
    mesh.soup = std::move(soup);
    if (!mesh.soup.positions.empty())
        mesh.low = mesh.high = mesh.soup.positions.front();
    for (dvec3 const& p : mesh.soup.positions) {
        mesh.low = glm::min(mesh.low, p);
        mesh.high = glm::max(mesh.high, p);
    }
    return mesh;
}

} // namespace sahl

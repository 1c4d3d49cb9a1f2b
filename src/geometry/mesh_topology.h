// In: triangles as corners at places: equal numbers are equal positions. Out: which hang together, which way
// round they lie, where the surface ends.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sahl {

struct Topology {
    std::vector<std::uint32_t> component; // of each triangle
    std::vector<bool> turned;             // of each triangle: to be turned round so that neighbours agree
    std::vector<bool> open;               // of each component: it has a boundary
    std::uint64_t boundary_edges = 0;
    std::uint64_t non_manifold_edges = 0; // more than two triangles, or two that cannot be made to agree
};

using Corners = std::array<std::uint32_t, 3>;

/// By OpenMesh. Nothing where it refuses a triangle: neighbours that lie opposite ways round, an edge of more
/// than two triangles, parts that touch at a point; nor where its search at vertices of many edges would take
/// too long.
std::optional<Topology> topology_of_manifold(std::span<Corners const> triangles, std::size_t places);

/// By a sorted list of edges, whatever the triangles: those that meet at an edge are one component. Fewer
/// than half of the triangles of each piece are turned; where a piece has no two sides (a Möbius strip) none
/// are.
Topology topology_by_edges(std::span<Corners const> triangles);

} // namespace sahl

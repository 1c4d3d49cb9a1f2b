// In: triangles that may lie any way round and meet any how. Out: their topology, by a sorted list of edges.
#include "geometry/mesh_topology.h"

#include "math/joined_sets.h"

#include <algorithm>
#include <utility>

namespace sahl {

namespace {

/// An edge as one triangle has it.
struct Side {
    std::uint64_t edge; // lower place, higher place
    std::uint32_t triangle;
    bool forwards; // from the lower place to the higher
};

std::vector<Side> sorted_sides(std::span<Corners const> triangles) {
    std::vector<Side> sides;
    sides.reserve(triangles.size() * 3);
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) {
            std::uint64_t const a = triangles[t][static_cast<std::size_t>(i)];
            std::uint64_t const b = triangles[t][static_cast<std::size_t>((i + 1) % 3)];
            sides.push_back({std::min(a, b) << 32 | std::max(a, b), t, a < b});
        }
    std::sort(sides.begin(), sides.end(), [](Side const& x, Side const& y) {
        return std::pair(x.edge, x.triangle) < std::pair(y.edge, y.triangle);
    });
    return sides;
}

/// Two triangles at one edge; `opposed`: one of them must be turned for them to agree.
struct Neighbour {
    std::uint32_t triangle = none;
    bool opposed = false;
    static constexpr std::uint32_t none = 0xFFFFFFFFu;
};

using Neighbours = std::vector<std::array<Neighbour, 3>>; // of each triangle, in no order

void link(Neighbours& neighbours, std::uint32_t triangle, Neighbour const& neighbour) {
    for (Neighbour& place : neighbours[triangle])
        if (place.triangle == Neighbour::none) {
            place = neighbour;
            return;
        }
}

/// Turns triangles of the piece that `first` is in until neighbours agree, the smaller part of them; returns
/// at how many edges they still do not, and then turns none.
std::uint64_t orient_piece(Neighbours const& neighbours, std::uint32_t first, std::vector<bool>& reached,
                           std::vector<bool>& turned) {
    std::vector<std::uint32_t> piece{first};
    reached[first] = true;
    std::size_t number_turned = 0;
    std::uint64_t conflicts = 0; // each is seen from both sides
    for (std::size_t i = 0; i < piece.size(); ++i)
        for (Neighbour const& neighbour : neighbours[piece[i]]) {
            if (neighbour.triangle == Neighbour::none)
                continue;
            bool const wanted = turned[piece[i]] != neighbour.opposed;
            if (reached[neighbour.triangle]) {
                conflicts += turned[neighbour.triangle] != wanted;
                continue;
            }
            reached[neighbour.triangle] = true;
            turned[neighbour.triangle] = wanted;
            number_turned += wanted;
            piece.push_back(neighbour.triangle);
        }
    bool const undo = conflicts > 0;
    bool const swap = !undo && 2 * number_turned > piece.size();
    for (std::uint32_t const t : piece)
        turned[t] = !undo && turned[t] != swap;
    return conflicts / 2;
}

} // namespace

Topology topology_by_edges(std::span<Corners const> triangles) {
    Topology topology;
    std::vector<Side> const sides = sorted_sides(triangles);
    Neighbours neighbours(triangles.size());
    JoinedSets sets(triangles.size());
    std::vector<std::uint32_t> at_boundary;
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        for (end = begin; end < sides.size() && sides[end].edge == sides[begin].edge; ++end)
            sets.join(sides[begin].triangle, sides[end].triangle);
        Side const& a = sides[begin];
        if (end - begin == 1) {
            ++topology.boundary_edges;
            at_boundary.push_back(a.triangle);
        } else if (end - begin == 2) {
            Side const& b = sides[begin + 1];
            link(neighbours, a.triangle, {b.triangle, a.forwards == b.forwards});
            link(neighbours, b.triangle, {a.triangle, a.forwards == b.forwards});
        } else {
            ++topology.non_manifold_edges;
        }
    }
    topology.turned.assign(triangles.size(), false);
    std::vector<bool> reached(triangles.size(), false);
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        if (!reached[t])
            topology.non_manifold_edges += orient_piece(neighbours, t, reached, topology.turned);

    topology.component.resize(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) { // the lowest number of a set represents it
        bool const is_first = sets.find(t) == t;
        topology.component[t] =
            is_first ? static_cast<std::uint32_t>(topology.open.size()) : topology.component[sets.find(t)];
        if (is_first)
            topology.open.push_back(false);
    }
    for (std::uint32_t const t : at_boundary)
        topology.open[topology.component[t]] = true;
    return topology;
}

} // namespace sahl

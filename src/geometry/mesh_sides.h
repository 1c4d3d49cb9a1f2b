// In: triangles as corners at places: equal numbers are equal positions. Out: what lies across each of their
// sides, by linear passes, whatever the triangles: for what a structure of manifolds alone would refuse.
#pragma once

#include "geometry/mesh_topology.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sahl {

/// Side 3t + i of triangle t runs from its corner i to the next one; it also stands for that corner.
struct Sides {
    static constexpr std::uint32_t border = 0xFFFFFFFFu;  // nothing lies across
    static constexpr std::uint32_t crowded = 0xFFFFFFFEu; // more than one triangle, or one that lies the
                                                          // other way round
    std::vector<std::uint32_t> across;                    // the neighbour's side, or one of these
    std::vector<std::uint32_t> crowded_edges;             // one side of each

    bool is_joined(std::uint32_t side) const { return across[side] < crowded; }
};

constexpr std::uint32_t next_side(std::uint32_t side) {
    return side % 3 == 2 ? side - 2 : side + 1;
}
constexpr std::uint32_t previous_side(std::uint32_t side) {
    return side % 3 == 0 ? side + 2 : side - 1;
}

Sides pair_sides(std::span<Corners const> triangles, std::size_t places);

/// Calls `take(corners)` for each fan: the corners at one place that hang together by joined sides.
template <class Take>
void for_each_fan(std::vector<std::uint32_t> const& across, Take const& take) {
    std::vector<bool> seen(across.size(), false);
    std::vector<std::uint32_t> fan;
    for (std::uint32_t start = 0; start < across.size(); ++start) {
        if (seen[start])
            continue;
        std::uint32_t first = start;
        for (std::uint32_t back = across[previous_side(first)]; back < Sides::crowded && back != start;
             back = across[previous_side(first)])
            first = back;
        fan.clear();
        for (std::uint32_t corner = first; !seen[corner];) {
            seen[corner] = true;
            fan.push_back(corner);
            if (across[corner] >= Sides::crowded)
                break;
            corner = next_side(across[corner]);
        }
        take(std::span<std::uint32_t const>(fan));
    }
}

} // namespace sahl

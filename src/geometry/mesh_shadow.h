// In: the triangles of a closed surface. Out: whether a point is inside, by the crossings of a slanted line.
#pragma once

#include "math/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sahl {

/// A closed surface, projected along a slanted line, its triangles sorted by where they begin.
struct Shadow {
    struct Triangle {
        double begin, end;            // in x
        std::array<dvec3, 3> corners; // z is along the line
    };
    std::vector<Triangle> triangles;
    double widest = 0.0; // of their extents in x
};

Shadow make_shadow(std::span<dvec3 const> positions, std::span<std::array<std::uint32_t, 3> const> triangles);

/// How often the surface goes round the point; 0: outside. A point on the surface is on either side.
int winding_number(Shadow const& shadow, dvec3 const& point);

} // namespace sahl

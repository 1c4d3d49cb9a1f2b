// In: the coordinates of a mesh as its file has them. Out: in what steps they stand there, and the mesh moved
// by what these steps leave open.
#pragma once

#include "geometry/mesh.h"

#include <cstdint>
#include <span>

namespace sahl {

/// What numbers of a file are rounded to.
struct DataSteps {
    bool floats = false; // every one is a float: a step is the float's own
    double even = 0.0;   // else the largest power of ten, at least 1e-12 of the greatest, that all are
                         // multiples of; 0: none, their digits are those of a double
};
DataSteps steps_of(std::span<dvec3 const> values);

/// By how much more than rounding does (RMS) a shaken mesh's numbers are moved: whole steps, so that they
/// stay numbers of that kind.
inline constexpr double shaken_by = 2.449489742783178; // √6: a half over a twelfth

/// The mesh with every number of its places one step higher or lower, a quarter of them each way, and its
/// normals, whose steps are no longer known once they are unit, moved by as much of floats; what lies at one
/// place stays together.
Mesh shaken(Mesh const& mesh, std::uint64_t seed = 1);

} // namespace sahl

// In: a mesh, its smooth pieces known. Out: the solid of planes, spheres and cylinders that it stands for, if
// it is one.
#pragma once

#include "geometry/smooth_fans.h"
#include "geometry/solid.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sahl {

struct RecognisedSolid {
    Solid solid;
    std::vector<std::uint32_t> face_of_region; // the mesh's face for each of the solid's
    double residual = 0.0;                     // m: how far a vertex lies off
    double normals_off = 0.0;                  // rad: how far a normal of the file does
};

/// Of one closed shell whose every smooth piece is a plane, a sphere or a cylinder to four units in the last
/// place of float coordinates, and normals (where the file's count) to 1e-6 rad, so that the body is what
/// lies behind all of them. Else nothing.
/// From half of the vertices alone (or, where a piece has few, all but one), two such solids tell by how much
/// they differ how far one from all can be trusted. There are several ways to halve: some by chance, and
/// some by bands of distance from a piece's middle, taken by turns, which tell if it bends otherwise than
/// what it is held to be.
struct VertexShare {
    std::optional<unsigned> way{}; // below ways_to_halve; none: all vertices
    bool rest = false;             // the other half
};
inline constexpr unsigned ways_by_chance = 3, ways_to_halve = 6;
std::optional<RecognisedSolid> recognise(SmoothFans const& fans, VertexShare share = {});

} // namespace sahl

// In: triangles. Out: them as a page draws them: fewer where there are too many, sorted by face, with the
// edges at which a person sees that faces meet.
#pragma once

#include "geometry/mesh.h"

#include <cstdint>
#include <vector>

namespace sahl::report {

/// Lengths in mm, in the mesh's own frame.
struct DrawnMesh {
    std::vector<float> places;              // three a corner
    std::vector<std::int16_t> normals;      // three a corner, 32767 times a unit vector; or none
    std::vector<std::uint32_t> triangles;   // three corners each, by face
    std::vector<std::uint32_t> face_begins; // of each face its first triangle, and their number
    std::vector<std::uint32_t> creases;     // two corners each: faces meet there, or turn by more than 30°
    std::vector<std::uint32_t> borders;     // two corners each: where the surface ends
    std::uint64_t triangles_of_model = 0;   // before some were left out
};

/// Corners that fall into one cell of a grid become one, where there are more than `most` triangles; the grid
/// is as fine as that allows.
DrawnMesh drawn_mesh(TriangleSoup const& soup, std::size_t most);

} // namespace sahl::report

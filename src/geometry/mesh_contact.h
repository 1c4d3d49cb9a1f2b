// In: two meshes, or a mesh and a plane, and how they stand to each other. Out: the triangles that lie on
// each other, whatever the triangulation.
#pragma once

#include "geometry/contact.h"
#include "geometry/embree/box_tree.h"
#include "geometry/mesh.h"

#include <cstdint>
#include <vector>

namespace sahl {

/// How exactly a mesh's data say where it is: a coordinate that was read as a float may lie half a unit in
/// the last place of a float from what was meant, and whoever wrote it rounded before.
bool has_float_positions(Mesh const& mesh);

/// Two triangles that lie on each other and overlap.
struct TriangleFit {
    std::uint32_t one = 0, other = 0;
    double apart = 0.0;            // m: how far a corner of one lies off the other's plane or corner
    double tolerance = 0.0;        // m: what the data's own rounding accounts for there, along the normal
    double corner_tolerance = 0.0; // m: and in any direction
    bool same_corners = false;
    /// They have two corners in common and reach to the same side of them, but lie on no plane: halves of a
    /// quad that each mesh has cut along its own diagonal, if their other halves fit too. `apart` is ∞.
    bool other_diagonal = false;
};

/// What may be taken for rounding: in double always, in float where the data are floats.
struct FitTolerance {
    double placing = 0.0; // m, in the frame of the first
    bool one_is_float = false, other_is_float = false;
};

/// Frame and lengths are those of the first mesh.
std::vector<TriangleFit> fits_of(Mesh const& one, Mesh const& other, Affine const& other_to_one,
                                 FitTolerance const& tolerance);

/// Triangles of the mesh that lie on a plane in its frame and reach into a region; `other` is 0.
std::vector<TriangleFit> fits_of(Mesh const& mesh, PlaneCarrier const& plane, Bounds const& region,
                                 FitTolerance const& tolerance);

} // namespace sahl

// In: an exact shape. Out: triangles whose corners lie on it, with its own normals there.
#pragma once

#include "geometry/mesh.h"
#include "geometry/shape.h"

#include <string>

namespace sahl {

/// Into how many pieces a full turn may be cut.
inline constexpr unsigned coarsest_turn = 6, finest_turn = 3000;

struct Tessellation {
    TriangleSoup soup;   // metres, the shape's own frame; faces as face_names() has them
    std::string problem; // not empty: why there are no triangles, and what to do
};

/// Corners lie on the surface to rounding, so that what is between errs by the square of the pieces' length;
/// normals are the surface's own, out of a closed shape, towards +z of an open one. A corner belongs to one
/// face: where faces meet, each has it at exactly the same place, also as floats, so that a closed shape is
/// closed after welding by position. At an apex, which has no normal, each triangle has its own.
///   turn   pieces of a full turn, [coarsest_turn, finest_turn]; the next multiple of 6 is taken. Along a
///          meridian the pieces are as long as those of the rim, straight lines are not cut, and a quadric's
///          box is cut into cells of a third as many along its longest side. Flat faces are exact.
/// A plane has no end and cannot be; neither can a quadric that encloses nothing, or is thinner than a cell.
Tessellation tessellate(Shape const& shape, unsigned turn);

} // namespace sahl

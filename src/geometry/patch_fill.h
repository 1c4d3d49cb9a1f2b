// In: a patch's corners, and polynomials at them, or none. Out: its heights and tilts.
#pragma once

#include "geometry/patch_fit.h"
#include "geometry/patch_relief.h"

#include <array>

namespace sahl {

/// What runs through a triangle's corners.
enum class PatchKind : std::uint8_t {
    quadratic, // heights over the chords by the normals at their ends; the light's normal is the corners',
               // weighted
    fitted,    // polynomials of degree 4, one at each vertex, weighted
    apart      // as fitted, but for light's normals, which those of the farther corners give: for pilots
};

/// Polynomials at a triangle's corners; none: the quadratic surface stands in.
using CornerFields = std::array<HeightField const*, 3>;

/// Heights and tilts of a bare patch. A side's heights come from its own ends alone, so that its two
/// triangles agree to the bit; where a polynomial strays from the quadratic surface by more than the relief's
/// room, that side is quadratic. Returns whether all is near to the quadratic surface.
Patch::Made fill(Patch& patch, SmoothFans const& fans, std::uint32_t triangle, Relief const& relief,
                 CornerFields const& fields, PatchKind kind);

} // namespace sahl

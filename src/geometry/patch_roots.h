// In: a patch and a line. Out: every place where they meet, whatever the patch is like and however the line
// runs. The surface alone decides, and not the cell that it lies in.
#pragma once

#include "geometry/patch.h"
#include "math/inline_vector.h"

namespace sahl {

struct PatchRoot {
    double t = 0.0, v = 0.0, w = 0.0;
    dvec3 outward{0.0}; // not unit
};

/// More than a polynomial of degree 5 is met by any line that is not made for it.
using PatchRoots = InlineVector<PatchRoot, 16>;

/// By cutting the patch in halves for as long as the line may meet it more than once (the hull of Bernstein's
/// coefficients tells), and by Newton's method where once at most. Two places nearer to each other than 1e-6
/// of the patch, in opposite senses, may be left out both.
///   slack   weight: how far beside the patch it is met too
PatchRoots roots_of(Patch const& patch, dvec3 const& origin, dvec3 const& direction, double slack);

} // namespace sahl

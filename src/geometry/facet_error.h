// In: a mesh. Out: how far the smooth surface that it stands for may lie off each of its triangles.
#pragma once

#include "geometry/mesh.h"

#include <vector>

namespace sahl {

/// m, by triangle: half the angle to a neighbour times the triangle's height over their edge, the largest of
/// its three. On a sphere that is one and a half times the sag of an equilateral triangle, on a cylinder four
/// times that of a strip. 0: it is flat all round; edges sharper than 30° are meant.
std::vector<double> facet_errors(Mesh const& mesh);

} // namespace sahl

// In: a mesh far finer than it need be. Out: one of fewer triangles at the same places.
#pragma once

#include "geometry/mesh.h"

#include <optional>

namespace sahl {

/// Collapses edges while every vertex that is left out lies within `tolerance` (m in the mesh's frame) of the
/// triangles left. Those that stay keep their places and normals, and all on creases, on borders between
/// faces, where normals part, and where the mesh ends stay, so that curved methods have as good data, if
/// fewer. By least quadrics (M. Garland, P. S. Heckbert, SIGGRAPH 97, 209), by OpenMesh. Nothing where it is
/// no manifold.
std::optional<Mesh> decimated(Mesh const& mesh, double tolerance);

/// The most that a map makes longer, or a little more.
double stretch_of(Affine const& to_world);

} // namespace sahl

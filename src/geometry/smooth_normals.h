// In: a mesh whose file has no normals. Out: the same mesh with some, as light that is to look smooth needs.
#pragma once

#include "geometry/mesh.h"

#include <memory>

namespace sahl {

/// Where the mesh has no normals: those of the triangles round each vertex, weighed as Max (1999) does, up to
/// folds of 30°. Vertices on folds become several; all else of the mesh stays.
std::shared_ptr<Mesh const> with_smooth_normals(std::shared_ptr<Mesh const> mesh);

} // namespace sahl

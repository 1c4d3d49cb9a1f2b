// In: a scene whose meshes are met by a method that was asked for. Out: where the file's normals make that
// method worse than the user may think.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace sahl {

/// Of each closed mesh that is not met by its triangles alone: normals of few digits or first order only,
/// which interpolation follows and curved surfaces do not; normals averaged over creases, near which
/// interpolation is worse than the triangles. And of each mesh that a curved method was asked for and that
/// has holes or is open: it is met by its triangles.
std::vector<std::string> normal_warnings(Scene const& scene);

} // namespace sahl

// In: a Wavefront OBJ file and the MTL files that it names. Out: a Model, or an InputError that names file,
// line, problem and remedy.
#pragma once

#include "scene/model.h"

#include <filesystem>

namespace sahl {

/// Polygons, normals and materials; points, lines, free-form surfaces and textures are left out. Lengths are
/// as in the file. A mesh is made of each object (o), in a file without objects of each group (g), and those
/// that share vertices are one mesh; its faces are named after its groups where it has several, else after
/// its materials. How a material is understood stands in docs/models.md. Nothing in the files is trusted: MTL
/// files must lie in the model's folder, the OBJ file has at most 1 GiB and 2²⁵ triangles; every index and
/// number is checked before it is used.
Model read_obj(std::filesystem::path const& path);

} // namespace sahl

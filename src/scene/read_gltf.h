// In: a glTF 2.0 file, .gltf or .glb. Out: a Model, or an InputError that names the place and the remedy.
// read_gltf*.cpp are the door to tinygltf.
#pragma once

#include "scene/model.h"

#include <filesystem>

namespace sahl {

/// Triangles, normals, nodes and materials. Images, skins, morph targets, animations, lights and cameras are
/// left out, with a warning. Nothing in the file is trusted: its buffers must lie in its own folder, and all
/// files together stay below 1 GiB; every size, index and number is checked before it is used.
Model read_gltf(std::filesystem::path const& path);

} // namespace sahl

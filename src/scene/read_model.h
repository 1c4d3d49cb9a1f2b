// In: a model file, told by its ending. Out: a Model, whichever format it is in.
#pragma once

#include "scene/model.h"

#include <filesystem>

namespace sahl {

/// Is this the name of a model that read_model reads: .gltf, .glb or .obj, in capitals or not?
bool is_model_file(std::filesystem::path const& path);

/// Is it the name of a model in a format that is not read?
bool is_foreign_model_file(std::filesystem::path const& path);

/// Lengths are as in the file: metres in glTF, in OBJ whatever its maker chose. Throws InputError with the
/// place, the problem and the remedy.
Model read_model(std::filesystem::path const& path);

} // namespace sahl

// In: a scene. Out: its bodies as the data of a model file: meshes, instances, materials.
#pragma once

#include "scene/model.h"
#include "scene/scene.h"

namespace sahl {

/// Every body and open surface: meshes as they are, exact shapes tessellated (geometry/tessellate.h), where
/// equal ones share a mesh. A transform that glTF has no word for, with shear, is applied to the mesh.
/// Rectangular detectors are left out, unless they are asked for: then they are thin veils that show where
/// they stand.
///   turn    pieces of a full turn, [coarsest_turn, finest_turn]
///   place   what the errors name: the experiment's file
/// Throws InputError where a shape cannot be tessellated.
Model model_of(Scene const& scene, unsigned turn, bool with_detectors, std::string const& place);

} // namespace sahl

// In: an experiment. Out: what stands in it, as a model file.
#pragma once

#include "run/run.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sahl {

/// Its bodies as .glb (see run/model_of_scene.h).
///   turn   pieces of a full turn, [coarsest_turn, finest_turn] (geometry/tessellate.h)
///   decimate   m in the world: meshes have fewer triangles, no vertex farther off them than this
///   (geometry/mesh_decimate.h); 0: all
///   subdivide   m in the world: meshes have more, nearer than this to the surface that they stand for
///   (geometry/mesh_subdivide.h); 0: as many as they have
/// Returns what was done to each mesh that was to have fewer or more. Throws InputError, and then nothing is
/// written.
std::vector<std::string> export_model(ExperimentSource const& source, unsigned turn,
                                      std::filesystem::path const& to, double decimate = 0.0,
                                      double subdivide = 0.0);

} // namespace sahl

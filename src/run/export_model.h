// In: an experiment. Out: what stands in it, as a model file.
#pragma once

#include "run/run.h"

#include <filesystem>

namespace sahl {

/// Its bodies as .glb (see run/model_of_scene.h).
///   turn   pieces of a full turn, [coarsest_turn, finest_turn] (geometry/tessellate.h)
/// Throws InputError, and then nothing is written.
void export_model(ExperimentSource const& source, unsigned turn, std::filesystem::path const& to);

} // namespace sahl

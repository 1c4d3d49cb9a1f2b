// In: an experiment whose picture asks for caustics. Out: the light of its sources on a detector, as a layer
// of the picture.
#pragma once

#include "render/light_map.h"
#include "run/trace_scene.h"
#include "scene/picture.h"

#include <atomic>
#include <optional>

namespace sahl {

class ModelCache;

/// Traces the sources to the detector that the picture names. Throws InputError where there is none, or no
/// source. The same layer, bit for bit, for any number of threads.
///   stop   once it is set, the layer has what was done, and is of no use
std::optional<LightMap> light_layer(Experiment const& experiment, ModelCache* models, unsigned threads,
                                    Progress const& progress, std::atomic<bool> const& stop);

} // namespace sahl

// In: a scene with meshes and a tolerance. Out: by which method each mesh is met, and a bound on the error of
// directions.
#pragma once

#include "run/path_errors.h"
#include "scene/scene_methods.h"

#include <optional>
#include <string>
#include <vector>

namespace sahl {

struct ObjectChoice {
    Method method = Method::automatic;
    std::optional<double> bound;   // rad; nothing: not known
    double sequence_changed = 0.0; // share of the pilots that meet other events by the method chosen
    double reference_bound = 0.0;  // rad, of the bound: what the method errs that it was held against
};

struct MethodChoice {
    std::vector<ObjectChoice> bodies; // by body
    std::vector<std::string> warnings;
};

/// Each closed mesh whose file has normals, and not just those of its triangles, is met by the first of
/// recognised, facet, interpolated, quadratic, fitted whose bound is within its share of the tolerance; if
/// none is, by that of the least bound, with a warning. The scene is changed to that.
/// Where the experiment asks for it, in fewer triangles than the file has.
MethodChoice choose_methods(Scene& scene, WavelengthTable const& optics, Emission const& emission,
                            TraceOptions const& options);

/// By what method, and in which triangles, each mesh of a run is met: as chosen, or as the experiment asks.
MethodChoice settle_methods(Scene& scene, WavelengthTable const& optics, Emission const& emission,
                            TraceOptions const& options);

} // namespace sahl

// In: a scene with meshes and a tolerance. Out: what fineness each mesh really carries: how far directions
// err by each method, what the digits of its file leave open, and how many triangles the tolerance takes.
#pragma once

#include "run/method_levels.h"
#include "scene/value.h"

#include <optional>

namespace sahl {

/// For each mesh that may be curved, bodies that touch taken together; keys in docs/check.md. The scene's
/// geometry is changed: it is not to be traced after this.
Value mesh_fits(Scene& scene, WavelengthTable const& optics, Emission const& emission,
                TraceOptions const& options);

/// How many triangles of the same kind would bring a bound (rad) that some have to a tolerance, if the error
/// falls with the method's order; nothing where it is rounding alone, or below what the digits leave open.
std::optional<double> triangles_for(MethodLevel const& level, double triangles, double tolerance,
                                    double floor);

/// Light for a model that comes without any: three parallel beams, along x, y, z, each over 80 % of what the
/// bodies are across, so that the directions of light which has gone in and out tell of their surfaces.
std::vector<SourceSpec> probing_beams(Scene const& scene);

/// As text for a person, of what mesh_fits returns.
std::string fits_text(Value const& fits);

} // namespace sahl

// In: a scene. Out: what a few rays tell beforehand: whether polarisation or dispersion matters to a run.
#pragma once

#include "run/dispersion_pilot.h"
#include "run/polarisation_pilot.h"
#include "scene/value.h"

#include <optional>

namespace sahl {

/// What pilots tell of what is not traced, or need not be.
struct Pilots {
    std::optional<std::vector<PolarisationMove>> polarisation; // nothing: not asked for
    std::vector<SourceDispersion> dispersion;
};

Pilots send_pilots(Scene const& scene, WavelengthTable const& optics, Emission const& emission,
                   TraceOptions const& options);

/// As it stands in summary.json and in a check's report.
Value pilots_value(Pilots const& pilots);

} // namespace sahl

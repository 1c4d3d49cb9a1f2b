// In: a scene. Out: how much its detectors' readings would move if s and p were kept apart.
#pragma once

#include "trace/tracer.h"

#include <string>
#include <vector>

namespace sahl {

/// One figure per detector: |P_kept_apart − P_mean| / P_mean over pilot rays; 0 where no pilot ray arrives.
/// The mean of s and p at each surface is exact for one surface; over several, a beam that was partly
/// polarised by one is treated by the next as if it were not. The figure is exact where all planes of
/// incidence of a path coincide, a guide elsewhere.
std::vector<double> polarisation_shift(Scene const& scene, WavelengthTable const& optics,
                                       Emission const& emission, TraceOptions const& options);

/// A warning for each detector whose power would move by more than options.tolerance_power.
std::vector<std::string> polarisation_warnings(Scene const& scene, WavelengthTable const& optics,
                                               Emission const& emission, TraceOptions const& options);

} // namespace sahl

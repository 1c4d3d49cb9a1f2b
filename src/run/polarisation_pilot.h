// In: a scene. Out: how much powers would move if s and p were kept apart.
#pragma once

#include "trace/tracer.h"

#include <string>
#include <vector>

namespace sahl {

struct PolarisationMove {
    std::string what;  // "detector screen"; "light that escapes from lens.front"
    double mean = 0.0; // W, of all rays as the pilots tell it: as it is traced, with the mean of s and p
    double apart = 0.0;
    double share = 0.0; // apart − mean as a share of the detector's power; of what is emitted where there is
                        // no detector
};

/// Pilots of each source, traced with the mean of s and p at each surface, and with the two kept apart from
/// the source's own polarisation on: one figure for each detector; where there are none, one for each face
/// that light escapes from and for each face and body that absorbs. Ways that do not interfere are added.
std::vector<PolarisationMove> polarisation_moves(Scene const& scene, WavelengthTable const& optics,
                                                 Emission const& emission, TraceOptions const& options);

/// A warning for each that would move by more than `tolerance`, a share.
std::vector<std::string> polarisation_warnings(std::vector<PolarisationMove> const& moves, double tolerance);

} // namespace sahl

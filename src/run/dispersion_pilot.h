// In: a scene whose sources have several wavelengths. Out: how far dispersion parts their ways.
#pragma once

#include "trace/tracer.h"

#include <string>
#include <vector>

namespace sahl {

/// Of one source of several wavelengths.
struct SourceDispersion {
    std::string source;
    std::uint64_t wavelengths = 0;
    double turn = 0.0;             // rad: the greatest angle between a direction at one and at another
    double sequence_changed = 0.0; // share of the pilots that meet other events at some of them
};

/// Pilots of each such source, the same rays at the wavelengths where some medium's index is least or
/// greatest, and at its first, each against each. 0 where no medium disperses.
std::vector<SourceDispersion> dispersions(Scene const& scene, WavelengthTable const& optics,
                                          Emission const& emission, TraceOptions const& options);

/// A line for each source all of whose wavelengths take the same ways to within `tolerance` (rad).
std::vector<std::string> dispersion_notes(std::vector<SourceDispersion> const& found, double tolerance);

} // namespace sahl

// In: a medium and a wavelength. Out: its absorption there.
#include "materials/medium.h"

#include "materials/interpolate.h"

namespace sahl {

double absorption_coefficient(Medium const& medium, double wavelength) {
    if (medium.absorption.empty())
        return 0.0;
    return interpolate(
        medium.absorption, wavelength, [](auto const& p) { return p.first; },
        [](auto const& p) { return p.second; });
}

} // namespace sahl

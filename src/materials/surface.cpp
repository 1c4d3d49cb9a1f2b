// In: a metal and a wavelength. Out: its complex index there.
#include "materials/surface.h"

#include "materials/interpolate.h"

namespace sahl {

std::complex<double> complex_index(Metal const& metal, double wavelength) {
    auto const at = [](Metal::Point const& p) { return p.wavelength; };
    return {interpolate(metal.table, wavelength, at, [](Metal::Point const& p) { return p.n; }),
            interpolate(metal.table, wavelength, at, [](Metal::Point const& p) { return p.k; })};
}

} // namespace sahl

#include "trace/wavelengths.h"

#include "math/input_error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace sahl {

WavelengthTable::WavelengthTable(Scene const& scene) {
    for (SourceSpec const& source : scene.sources)
        for (auto const& [wavelength, weight] : source.wavelengths)
            if (std::find(wavelengths_.begin(), wavelengths_.end(), wavelength) == wavelengths_.end())
                wavelengths_.push_back(wavelength);
    for (Medium const& medium : scene.media)
        for (double const wavelength : wavelengths_) {
            double const n = refractive_index(medium.index, wavelength);
            if (!(n > 0.0 && std::isfinite(n))) {
                std::ostringstream problem;
                problem << "has no refractive index at " << wavelength * 1e9 << " nm";
                throw InputError("medium " + medium.name, problem.str(),
                                 "take a wavelength within the range of its formula, or another medium");
            }
            indices_.push_back(n);
            absorption_.push_back(absorption_coefficient(medium, wavelength));
        }
    for (Surface const& surface : scene.surfaces)
        for (double const wavelength : wavelengths_) {
            auto const* const metal = std::get_if<Metal>(&surface.kind);
            metals_.push_back(metal ? complex_index(*metal, wavelength) : 0.0);
        }
}

WavelengthId WavelengthTable::id_of(double wavelength) const {
    auto const found = std::find(wavelengths_.begin(), wavelengths_.end(), wavelength);
    return {static_cast<std::uint32_t>(found - wavelengths_.begin())};
}

} // namespace sahl

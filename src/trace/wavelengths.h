// In: a scene and its wavelengths. Out: every index and coefficient that tracing needs, looked up once.
#pragma once

#include "math/ids.h"
#include "scene/scene.h"

#include <complex>
#include <vector>

namespace sahl {

/// All distinct wavelengths of the sources, in order of first use, with what each medium and metal is at
/// each.
class WavelengthTable {
  public:
    explicit WavelengthTable(Scene const& scene);

    WavelengthId id_of(double wavelength) const;                            // one of the scene's
    std::vector<double> const& wavelengths() const { return wavelengths_; } // m

    double index(MediumId medium, WavelengthId w) const { return indices_[at(medium.value, w)]; }
    double absorption(MediumId medium, WavelengthId w) const {
        return absorption_[at(medium.value, w)];
    } // 1/m
    std::complex<double> metal(SurfaceId surface, WavelengthId w) const {
        return metals_[at(surface.value, w)];
    }

  private:
    std::size_t at(std::uint32_t row, WavelengthId w) const { return row * wavelengths_.size() + w.value; }

    std::vector<double> wavelengths_;
    std::vector<double> indices_, absorption_; // [medium][wavelength]
    std::vector<std::complex<double>> metals_; // [surface][wavelength]; 0 where the surface is no metal
};

} // namespace sahl

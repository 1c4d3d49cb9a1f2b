// In: the sources of an experiment. Out: its rays, by number, each a pure function of that number and the
// seed.
#pragma once

#include "scene/experiment.h"
#include "trace/wavelengths.h"

#include <cstdint>
#include <vector>

namespace sahl {

struct Ray {
    dvec3 origin{0.0}, direction{0.0}; // m; unit
    double power = 0.0;                // W
    WavelengthId wavelength;
    SourceId source;
};

/// Ray numbers run through the sources in order, in each through its wavelengths, in each through its rays.
class Emission {
  public:
    Emission(std::vector<SourceSpec> const& sources, WavelengthTable const& optics, std::uint64_t seed);

    std::uint64_t rays() const { return first_.back(); }
    Ray ray(std::uint64_t number) const; // number < rays()
    double power() const;                // W, of all sources
    /// Number of each source's first ray, and the total as the last entry.
    std::vector<std::uint64_t> const& first_rays() const { return first_; }

  private:
    struct Prepared {
        SourceSpec const* spec;
        std::vector<WavelengthId> wavelengths;
        std::vector<double> wavelength_share;
        std::uint64_t rays = 0;      // per wavelength
        std::vector<dvec2> points;   // of a beam's pattern, in units of its size; empty where drawn by number
        std::vector<double> weights; // by wavelength: sum over its rays
    };
    dvec2 point(Prepared const& source, std::uint64_t number, std::uint64_t ray) const;
    double weight(Prepared const& source, dvec2 const& point, std::uint64_t number) const;

    std::vector<Prepared> sources_;
    std::vector<std::uint64_t> first_{0};
    std::uint64_t seed_;
};

} // namespace sahl

// In: the sources of an experiment. Out: its rays, by number, each a pure function of that number and the
// seed.
#pragma once

#include "scene/experiment.h"
#include "trace/shares.h"
#include "trace/wavelengths.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sahl {

/// The seed of the draws by which a ray is followed a second time.
std::uint64_t seed_again(std::uint64_t seed);

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
    /// number < rays(). The powers of a source's rays add up to its own exactly, in units of 2⁻⁹⁰ of power().
    /// again   with other draws: of a random pattern, of the directions of a lambertian source, and of a
    ///         Sobol point within its share of the square
    Ray ray(std::uint64_t number, bool again = false) const;
    double power() const; // W, of all sources
    /// Number of each source's first ray, and the total as the last entry.
    std::vector<std::uint64_t> const& first_rays() const { return first_; }

  private:
    struct Prepared {
        SourceSpec const* spec;
        std::vector<WavelengthId> wavelengths;
        std::vector<double> wavelength_share;
        std::uint64_t rays = 0;    // per wavelength
        std::vector<dvec2> points; // of a beam's pattern, in units of its size; empty where drawn by number
        // by wavelength, where all rays weigh the same; else what a weight of 1 stands for, in W
        std::vector<EqualShare> equal;
        std::vector<double> per_weight;
        std::optional<WeightedShares> weighted; // ray by ray, through the wavelengths
    };
    void weigh(Prepared& source, std::uint64_t first, SumUnit unit);
    dvec2 point(Prepared const& source, std::uint64_t number, std::uint64_t ray, std::uint64_t seed) const;
    double weight(Prepared const& source, dvec2 const& point, std::uint64_t number) const;

    std::vector<Prepared> sources_;
    std::vector<std::uint64_t> first_{0};
    std::uint64_t seed_;
};

} // namespace sahl

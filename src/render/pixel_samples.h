// In: how many samples a pixel gets. Out: where each lies and how it weighs: patterns and filters.
#pragma once

#include "math/vec.h"
#include "scene/picture.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sahl {

/// A filter as a way to place samples: as densely as its size, with the sign as weight, so that each pixel
/// has samples of its own and no other (M. Ernst, M. Stamminger, G. Greiner, "Filter importance sampling",
/// IEEE Symposium on Interactive Ray Tracing (2006)).
class FilterPlaces {
  public:
    explicit FilterPlaces(PixelFilter filter);
    struct Place {
        double offset; // from the pixel's middle, in pixels
        double weight; // 1 or −1
    };
    /// u in [0, 1)
    Place at(double u) const;
    double mean_weight() const { return mean_weight_; }

  private:
    static constexpr std::size_t steps = 2048, guides = 1024;
    double width() const { return 2.0 * radius_ / steps; } // of a step, in pixels

    bool box_;
    double radius_, changes_sign_; // beyond the latter it is negative
    double mean_weight_ = 1.0;
    std::vector<double> sum_{0.0};          // of |f| up to the end of each step, from −radius on; of all: 1
    std::vector<std::uint16_t> first_step_; // to look at for u from each guide/guides on
};

/// One-dimensional filters, 0 beyond their radius, at x pixels from the middle. Mitchell: D. P. Mitchell and
/// A. N. Netravali, Computer Graphics (SIGGRAPH) 22 (1988) 221, with B = C = 1/3.
double filter_value(PixelFilter filter, double x);
double filter_radius(PixelFilter filter);

struct PixelSample {
    dvec2 offset{0.0}; // from the pixel's middle, in pixels
    double weight = 1.0;
    dvec2 lens{0.0};   // in [0, 1)²
    double turn = 0.0; // in [0, 1): what shifts its wavelengths
};

class PixelSamples {
  public:
    /// lens, turns   are they asked for? Where not they are 0
    PixelSamples(PictureOptions const& options, std::uint64_t seed, bool lens = true, bool turns = true);
    /// Sample `index` of options.samples, of the pixel with this number.
    PixelSample at(std::uint64_t pixel, std::uint32_t index) const;
    /// Of many samples.
    double mean_weight() const { return filter_.mean_weight() * filter_.mean_weight(); }

  private:
    dvec2 square(std::uint64_t pixel, std::uint32_t index) const;

    SamplePattern pattern_;
    std::uint32_t samples_, side_; // side_²: cells of a regular or jittered pattern
    std::uint64_t seed_;
    bool lens_, turns_;
    FilterPlaces filter_;
};

} // namespace sahl

// In: the light that met a detector. Out: its power, where it fell, and its picture, the same bits in any
// order.
#pragma once

#include "scene/experiment.h"
#include "trace/tracer.h"

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace sahl {

/// Sums of one kind of light on one detector. Lengths in m.
struct Moments {
    std::uint64_t hits = 0;
    ExactSum power, power_x, power_y, power_r2, power_path;
    std::array<ExactSum, 3> power_direction;

    void add(DetectorHit const& hit, SumUnit unit);
};

/// What a person reads off them; nothing where no light came.
struct Spot {
    double power = 0.0; // W
    std::uint64_t hits = 0;
    dvec2 centroid{0.0};            // m
    double rms_radius = 0.0;        // m, about the centroid
    dvec3 mean_direction{0.0};      // unit
    double mean_optical_path = 0.0; // m
};
std::optional<Spot> spot_of(Moments const& moments, SumUnit unit);

class DetectorRecord {
  public:
    DetectorRecord(DetectorSpec const& spec, SumUnit unit, std::size_t wavelengths, std::size_t sources);

    /// Hits come in the order of rays.
    void add(DetectorHit const& hit);

    Moments const& all() const { return all_; }
    std::vector<Moments> const& by_wavelength() const { return by_wavelength_; }
    std::vector<Moments> const& by_source() const { return by_source_; }
    /// W/m² by pixel, row-major, the first row at the top (largest y).
    std::vector<double> irradiance() const;
    double peak() const; // W/m²
    /// Standard error of the power where branches were drawn at random: from how much neighbouring rays
    /// differ, which also counts what they differ in truth, so it does not promise too much.
    double sigma() const;
    DetectorSpec const& spec() const { return spec_; }

  private:
    void close_ray();

    DetectorSpec spec_;
    SumUnit unit_, square_unit_;
    Moments all_;
    std::vector<Moments> by_wavelength_, by_source_;
    std::vector<ExactSum> pixels_;
    // the power that each ray brings, for sigma
    std::optional<std::uint64_t> ray_, previous_ray_;
    double ray_power_ = 0.0, previous_power_ = 0.0;
    ExactSum squared_differences_;
};

} // namespace sahl

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
    template <class Archive>
    void archive(Archive& all) {
        all(hits, power, power_x, power_y, power_r2, power_path, power_direction);
    }
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

/// Powers in bins of direction. What goes further from the axis than the last ring is counted apart.
class DirectionBins {
  public:
    DirectionBins(FarField const& far, SumUnit unit)
        : far_(far), unit_(unit), bins_(std::size_t{far.rings} * far.sectors) {}

    void add(dvec3 const& direction, double power);
    FarField const& far() const { return far_; }
    /// W by ring, from the axis on, and in it by sector, from azimuth 0 on.
    std::vector<double> powers() const;
    /// The same in W/sr.
    std::vector<double> intensities() const;
    double beyond() const { return beyond_.value(unit_); } // W
    template <class Archive>
    void archive(Archive& all) {
        all(bins_, beyond_);
    }

  private:
    FarField far_;
    SumUnit unit_;
    std::vector<ExactSum> bins_;
    ExactSum beyond_;
};

/// Powers over equal bins of a length.
struct Histogram {
    double from = 0.0, to = 0.0; // m
    double rms = 0.0;            // m, about the mean
    std::vector<double> powers;  // W
};

/// Of rays that were followed twice, with other draws the second time: how much the two differ, and how much
/// there was.
struct TwiceSums {
    ExactSum differences, squares; // W²: Σ (Y − Y')², Σ (Y² + Y'²)

    void add(double once, double again, SumUnit power_unit);
    void add(TwiceSums const& other);
};

/// How much of what rays bring is left to chance: the share of their square that TwiceSums find,
///   σ² = Σ Y² · Σ (Y − Y')² / Σ (Y² + Y'²)
/// the first sum over all rays. Nothing is asked of how rays differ from each other in truth.
class Chance {
  public:
    explicit Chance(SumUnit power_unit) : power_unit_(power_unit) {}
    void add(std::uint64_t ray, double power); // in the order of rays
    void add(TwiceSums const& sums);
    /// W; 0 where no ray was followed twice, √Σ Y² where none of those that were brought any light.
    double sigma() const;
    template <class Archive>
    void archive(Archive& all) {
        all(ray_, ray_power_, squares_, followed_twice_, twice_);
    }

  private:
    SumUnit power_unit_;
    std::optional<std::uint64_t> ray_;
    double ray_power_ = 0.0;
    ExactSum squares_; // of the rays before ray_
    bool followed_twice_ = false;
    TwiceSums twice_;
};

class DetectorRecord {
  public:
    DetectorRecord(DetectorSpec const& spec, SumUnit unit, std::size_t wavelengths, std::size_t sources);

    /// Hits come in the order of rays.
    void add(DetectorHit const& hit);

    Moments const& all() const { return all_; }
    std::vector<Moments> const& by_wavelength() const { return by_wavelength_; }
    std::vector<Moments> const& by_source() const { return by_source_; }
    /// W/m² by pixel, row-major, the first row at the top (largest y); empty where it is no rectangle.
    std::vector<double> irradiance() const;
    double peak() const; // W/m²
    void add(TwiceSums const& sums) { chance_.add(sums); }
    /// Standard error of the power where something was left to chance, else 0.
    double sigma() const { return chance_.sigma(); }
    DetectorSpec const& spec() const { return spec_; }
    SumUnit unit() const { return unit_; }

    /// Where spec().spot: the radius (m) about the centroid within which 1 %, 2 %, … 100 % of the power lie.
    /// Empty without light.
    std::vector<double> encircled() const;
    std::optional<DirectionBins> const& far_field() const { return far_field_; }
    /// Where spec().path_bins: from the shortest to the longest optical path. Without light it has no bins.
    Histogram optical_paths() const;
    /// What it has counted so far; what it is, `spec`, stays.
    template <class Archive>
    void archive(Archive& all) {
        all(all_, by_wavelength_, by_source_, pixels_, spots_, paths_, chance_);
        if (far_field_) // both ways: the spec says so
            all(*far_field_);
    }

  private:
    void add_to_pixel(DetectorHit const& hit);

    DetectorSpec spec_;
    SumUnit unit_;
    Moments all_;
    std::vector<Moments> by_wavelength_, by_source_;
    std::vector<ExactSum> pixels_; // none but of a rectangle
    std::optional<DirectionBins> far_field_;
    struct Spotted {
        dvec2 at;
        double power;
    };
    std::vector<Spotted> spots_;                   // where asked for
    std::vector<std::pair<double, double>> paths_; // optical path, power; where asked for
    Chance chance_;
};

} // namespace sahl

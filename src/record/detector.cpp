#include "record/detector.h"

#include <algorithm>
#include <cmath>

namespace sahl {

void Moments::add(DetectorHit const& hit, SumUnit unit) {
    ++hits;
    power.add(hit.power, unit);
    power_x.add(hit.power * hit.at.x, unit);
    power_y.add(hit.power * hit.at.y, unit);
    power_r2.add(hit.power * dot(hit.at, hit.at), unit);
    power_path.add(hit.power * hit.optical_path, unit);
    for (int axis = 0; axis < 3; ++axis)
        power_direction[static_cast<std::size_t>(axis)].add(hit.power * hit.direction[axis], unit);
}

std::optional<Spot> spot_of(Moments const& moments, SumUnit unit) {
    double const power = moments.power.value(unit);
    if (moments.hits == 0 || power <= 0.0)
        return std::nullopt;
    Spot spot;
    spot.power = power;
    spot.hits = moments.hits;
    spot.centroid = {moments.power_x.value(unit) / power, moments.power_y.value(unit) / power};
    double const mean_r2 = moments.power_r2.value(unit) / power;
    spot.rms_radius = std::sqrt(std::max(0.0, mean_r2 - dot(spot.centroid, spot.centroid)));
    auto const& sum = moments.power_direction;
    dvec3 const direction(sum[0].value(unit), sum[1].value(unit), sum[2].value(unit));
    double const size = length(direction);
    spot.mean_direction = size > 0.0 ? direction / size : direction; // opposite beams may have no mean
    spot.mean_optical_path = moments.power_path.value(unit) / power;
    return spot;
}

DetectorRecord::DetectorRecord(DetectorSpec const& spec, SumUnit unit, std::size_t wavelengths,
                               std::size_t sources)
    : spec_(spec), unit_(unit), square_unit_{2 * unit.exponent + 90}, by_wavelength_(wavelengths),
      by_source_(sources), pixels_(std::size_t{spec.columns} * spec.rows) {}

void DetectorRecord::add(DetectorHit const& hit) {
    all_.add(hit, unit_);
    by_wavelength_[hit.wavelength.value].add(hit, unit_);
    by_source_[hit.source.value].add(hit, unit_);
    auto const pixel = [](double at, double size, std::uint32_t count) {
        double const position = (at / size + 0.5) * count;
        return static_cast<std::size_t>(std::clamp(position, 0.0, count - 1.0));
    };
    std::size_t const column = pixel(hit.at.x, spec_.size.x, spec_.columns);
    std::size_t const row = pixel(-hit.at.y, spec_.size.y, spec_.rows);
    pixels_[row * spec_.columns + column].add(hit.power, unit_);
    if (ray_ != hit.ray) {
        close_ray();
        ray_ = hit.ray;
        ray_power_ = 0.0;
    }
    ray_power_ += hit.power;
}

void DetectorRecord::close_ray() {
    if (!ray_)
        return;
    auto const square = [&](double x) { squared_differences_.add(x * x, square_unit_); };
    if (previous_ray_ && *previous_ray_ + 1 == *ray_) {
        square(ray_power_ - previous_power_);
    } else { // rays in between brought nothing
        square(previous_power_);
        square(ray_power_);
    }
    previous_ray_ = ray_;
    previous_power_ = ray_power_;
}

double DetectorRecord::sigma() const {
    DetectorRecord closed(*this);
    closed.close_ray();
    return std::sqrt(0.5 * (closed.squared_differences_.value(square_unit_) +
                            closed.previous_power_ * closed.previous_power_));
}

std::vector<double> DetectorRecord::irradiance() const {
    double const pixel_area = spec_.size.x * spec_.size.y / static_cast<double>(pixels_.size());
    std::vector<double> field;
    field.reserve(pixels_.size());
    for (ExactSum const& pixel : pixels_)
        field.push_back(pixel.value(unit_) / pixel_area);
    return field;
}

double DetectorRecord::peak() const {
    std::vector<double> const field = irradiance();
    return *std::max_element(field.begin(), field.end());
}

} // namespace sahl

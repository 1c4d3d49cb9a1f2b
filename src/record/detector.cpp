#include "record/detector.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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
    : spec_(spec), unit_(unit), by_wavelength_(wavelengths), by_source_(sources),
      pixels_(spec.kind == DetectorKind::rectangle ? std::size_t{spec.columns} * spec.rows : 0),
      chance_(unit) {
    if (spec.far_field)
        far_field_.emplace(*spec.far_field, unit);
}

void DetectorRecord::add(DetectorHit const& hit) {
    all_.add(hit, unit_);
    by_wavelength_[hit.wavelength.value].add(hit, unit_);
    by_source_[hit.source.value].add(hit, unit_);
    if (far_field_)
        far_field_->add(hit.direction, hit.power);
    if (spec_.spot)
        spots_.push_back({hit.at, hit.power});
    if (spec_.path_bins > 0)
        paths_.emplace_back(hit.optical_path, hit.power);
    add_to_pixel(hit);
    chance_.add(hit.ray, hit.power);
}

void DetectorRecord::add_to_pixel(DetectorHit const& hit) {
    if (pixels_.empty())
        return;
    auto const pixel = [](double at, double size, std::uint32_t count) {
        double const position = (at / size + 0.5) * count;
        return static_cast<std::size_t>(std::clamp(position, 0.0, count - 1.0));
    };
    std::size_t const column = pixel(hit.at.x, spec_.size.x, spec_.columns);
    std::size_t const row = pixel(-hit.at.y, spec_.size.y, spec_.rows);
    pixels_[row * spec_.columns + column].add(hit.power, unit_);
}

namespace {

/// Of sums of squared powers.
SumUnit square_unit(SumUnit power_unit) {
    return {2 * power_unit.exponent + 90};
}

} // namespace

void TwiceSums::add(double once, double again, SumUnit power_unit) {
    differences.add((once - again) * (once - again), square_unit(power_unit));
    squares.add(once * once + again * again, square_unit(power_unit));
}

void TwiceSums::add(TwiceSums const& other) {
    differences.add(other.differences);
    squares.add(other.squares);
}

void Chance::add(std::uint64_t ray, double power) {
    if (ray_ != ray) {
        squares_.add(ray_power_ * ray_power_, square_unit(power_unit_));
        ray_ = ray;
        ray_power_ = 0.0;
    }
    ray_power_ += power;
}

void Chance::add(TwiceSums const& sums) {
    followed_twice_ = true;
    twice_.add(sums);
}

double Chance::sigma() const {
    if (!followed_twice_)
        return 0.0;
    SumUnit const unit = square_unit(power_unit_);
    double const all = squares_.value(unit) + ray_power_ * ray_power_, seen = twice_.squares.value(unit);
    return std::sqrt(seen > 0.0 ? all * (twice_.differences.value(unit) / seen) : all);
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
    return field.empty() ? 0.0 : *std::max_element(field.begin(), field.end());
}

std::vector<double> DetectorRecord::encircled() const {
    auto const spot = spot_of(all_, unit_);
    if (!spot || spots_.empty())
        return {};
    std::vector<std::pair<double, double>> by_radius; // power may be 0
    by_radius.reserve(spots_.size());
    for (Spotted const& hit : spots_)
        by_radius.emplace_back(length(hit.at - spot->centroid), hit.power);
    std::sort(by_radius.begin(), by_radius.end());
    std::vector<double> radii;
    ExactSum within;
    auto next = by_radius.begin();
    for (int percent = 1; percent <= 100; ++percent) {
        // within an ulp, so that 100 % is reached
        double const wanted = spot->power * percent / 100.0 * (1.0 - 4e-16);
        while (next != by_radius.end() && (next == by_radius.begin() || within.value(unit_) < wanted))
            within.add((next++)->second, unit_);
        radii.push_back((next - 1)->first);
    }
    return radii;
}

Histogram DetectorRecord::optical_paths() const {
    Histogram histogram;
    auto const spot = spot_of(all_, unit_);
    if (!spot || paths_.empty())
        return histogram;
    auto const [shortest, longest] = std::minmax_element(
        paths_.begin(), paths_.end(), [](auto const& a, auto const& b) { return a.first < b.first; });
    histogram.from = shortest->first;
    histogram.to = longest->first;
    double const width = histogram.to - histogram.from;
    std::vector<ExactSum> bins(spec_.path_bins);
    ExactSum squares;
    for (auto const& [path, power] : paths_) {
        double const place = width > 0.0 ? (path - histogram.from) / width * spec_.path_bins : 0.0;
        bins[static_cast<std::size_t>(std::min(place, spec_.path_bins - 1.0))].add(power, unit_);
        double const off = path - spot->mean_optical_path;
        squares.add(power * off * off, unit_);
    }
    histogram.rms = std::sqrt(squares.value(unit_) / spot->power);
    for (ExactSum const& bin : bins)
        histogram.powers.push_back(bin.value(unit_));
    return histogram;
}

void DirectionBins::add(dvec3 const& direction, double power) {
    double const along = dot(direction, far_.axis);
    double const x = dot(direction, cross(far_.up, far_.axis)), y = dot(direction, far_.up);
    double const angle = std::atan2(std::hypot(x, y), along);
    if (angle > far_.largest * (1.0 + 1e-15)) {
        beyond_.add(power, unit_);
        return;
    }
    double azimuth = std::atan2(y, x) / (2.0 * std::numbers::pi);
    azimuth -= std::floor(azimuth);
    auto const bin = [](double share, std::uint32_t count) {
        return static_cast<std::size_t>(std::min(share * count, count - 1.0));
    };
    bins_[bin(angle / far_.largest, far_.rings) * far_.sectors + bin(azimuth, far_.sectors)].add(power,
                                                                                                 unit_);
}

std::vector<double> DirectionBins::powers() const {
    std::vector<double> powers;
    for (ExactSum const& bin : bins_)
        powers.push_back(bin.value(unit_));
    return powers;
}

std::vector<double> DirectionBins::intensities() const {
    std::vector<double> intensities = powers();
    double const ring = far_.largest / far_.rings;
    for (std::size_t i = 0; i < intensities.size(); ++i) {
        std::size_t const number = i / far_.sectors;
        double const middle = (static_cast<double>(number) + 0.5) * ring;
        // cos a − cos b = 2 sin((a + b)/2) sin((b − a)/2)
        intensities[i] /= 4.0 * std::numbers::pi / far_.sectors * std::sin(middle) * std::sin(0.5 * ring);
    }
    return intensities;
}

} // namespace sahl

#include "render/pixel_samples.h"

#include "math/random.h"
#include "math/sequences.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

/// What a pixel's numbers are drawn for.
enum class Stream : std::uint64_t { film = 1, lens = 2, colour = 3 };

std::uint64_t key(std::uint64_t seed, std::uint64_t pixel, Stream stream) {
    return mix64(mix64(seed + 0x9E3779B97F4A7C15 * static_cast<std::uint64_t>(stream)) + pixel);
}

double fraction(std::uint64_t word) {
    return static_cast<double>(word >> 11) * 0x1p-53;
}

} // namespace

double filter_radius(PixelFilter filter) {
    switch (filter) {
    case PixelFilter::box:
        return 0.5;
    case PixelFilter::tent:
        return 1.0;
    case PixelFilter::gaussian:
        return 1.5;
    case PixelFilter::mitchell:
        return 2.0;
    }
    return 0.5;
}

double filter_value(PixelFilter filter, double x) {
    x = std::abs(x);
    if (x > filter_radius(filter))
        return 0.0;
    switch (filter) {
    case PixelFilter::box:
        return 1.0;
    case PixelFilter::tent:
        return 1.0 - x;
    case PixelFilter::gaussian: // of half a pixel's deviation
        return std::exp(-2.0 * x * x);
    case PixelFilter::mitchell:
        return x < 1.0 ? ((7.0 * x - 12.0) * x * x + 16.0 / 3.0) / 6.0
                       : (((-7.0 / 3.0 * x + 12.0) * x - 20.0) * x + 32.0 / 3.0) / 6.0;
    }
    return 0.0;
}

FilterPlaces::FilterPlaces(PixelFilter filter)
    : box_(filter == PixelFilter::box), radius_(filter_radius(filter)),
      changes_sign_(filter == PixelFilter::mitchell ? 8.0 / 7.0 : radius_) {
    double net = 0.0;
    for (std::size_t i = 0; i < steps; ++i) {
        double const value = filter_value(filter, width() * (static_cast<double>(i) + 0.5) - radius_);
        sum_.push_back(sum_.back() + std::abs(value));
        net += value;
    }
    double const all = sum_.back();
    mean_weight_ = net / all;
    std::uint16_t step = 0;
    for (std::size_t i = 0; i < guides; ++i) {
        while (sum_[step + 1U] * guides <= static_cast<double>(i) * all)
            ++step;
        first_step_.push_back(step);
    }
    for (double& sum : sum_)
        sum /= all;
}

FilterPlaces::Place FilterPlaces::at(double u) const {
    if (box_)
        return {u - 0.5, 1.0};
    std::size_t step = first_step_[static_cast<std::size_t>(u * guides)];
    while (step + 1 < steps && sum_[step + 1] <= u)
        ++step;
    double const share = std::clamp((u - sum_[step]) / (sum_[step + 1] - sum_[step]), 0.0, 1.0);
    double const x = width() * (static_cast<double>(step) + share) - radius_;
    return {x, std::abs(x) > changes_sign_ ? -1.0 : 1.0};
}

PixelSamples::PixelSamples(PictureOptions const& options, std::uint64_t seed, bool lens, bool turns)
    : pattern_(options.pattern), samples_(options.samples),
      side_(static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(options.samples)) - 1e-9))),
      seed_(seed), lens_(lens), turns_(turns), filter_(options.filter) {}

dvec2 PixelSamples::square(std::uint64_t pixel, std::uint32_t index) const {
    if (pattern_ == SamplePattern::sobol)
        return samples_ == 1 ? dvec2(0.5) : sobol_2d(index, key(seed_, pixel, Stream::film));
    // where the samples do not fill the square of cells, they are spread over it
    std::uint64_t const cells = std::uint64_t{side_} * side_;
    std::uint64_t const cell = index * cells / samples_;
    dvec2 within(0.5);
    if (pattern_ == SamplePattern::jittered) {
        std::uint64_t const k = mix64(key(seed_, pixel, Stream::film) + index);
        within = {fraction(k), fraction(mix64(k))};
    }
    return (dvec2(cell % side_, cell / side_) + within) / static_cast<double>(side_);
}

PixelSample PixelSamples::at(std::uint64_t pixel, std::uint32_t index) const {
    dvec2 const place = square(pixel, index);
    auto const x = filter_.at(place.x), y = filter_.at(place.y);
    PixelSample sample;
    sample.offset = {x.offset, y.offset};
    sample.weight = x.weight * y.weight;
    if (lens_)
        sample.lens = sobol_2d(index, key(seed_, pixel, Stream::lens));
    if (!turns_)
        return sample;
    // the golden ratio's multiples share out the circle as evenly as any number of them can
    double const turn = fraction(key(seed_, pixel, Stream::colour)) + 0.6180339887498949 * index;
    sample.turn = turn - std::floor(turn);
    return sample;
}

} // namespace sahl

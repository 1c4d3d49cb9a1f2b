#include "run/ray_colours.h"

#include "image/colour_map.h"
#include "report/colour.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

constexpr double decades = 6.0; // of power, below the greatest

/// glTF's colours are linear: the curve of sRGB (IEC 61966-2-1) undone.
std::uint8_t linear(double srgb) {
    double const share = srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
}

template <class Rgb>
RayColours::Bytes bytes_of(Rgb const& colour) {
    return {linear(colour[0]), linear(colour[1]), linear(colour[2]), 255};
}

} // namespace

void RayColours::look_at(Segment const& segment) {
    most_power_ = std::max(most_power_, segment.power_start);
    deepest_ = std::max<unsigned>(deepest_, segment.depth);
}

RayColours::Bytes RayColours::of_power(double watts) const {
    double const below = watts > 0.0 ? std::log10(most_power_ / watts) : decades;
    return bytes_of(colour_of(1.0 - below / decades));
}

std::pair<RayColours::Bytes, RayColours::Bytes> RayColours::of(Segment const& segment) const {
    if (by_ == ColourBy::power)
        return {of_power(segment.power_start), of_power(segment.power_end)};
    double const depth = deepest_ > 0 ? static_cast<double>(segment.depth) / deepest_ : 0.0;
    Bytes const colour = by_ == ColourBy::wavelength
                             ? bytes_of(report::on_black(report::spectral_colour(segment.wavelength)))
                             : bytes_of(colour_of(depth));
    return {colour, colour};
}

} // namespace sahl

#include "report/colour.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sahl::report {

namespace {

struct Node {
    double nm;
    Rgb colour;
};

// Where the names of the colours lie in the spectrum; sRGB chosen by eye, linear in between.
constexpr std::array<Node, 12> spectrum{{{380, {0.45, 0.00, 0.60}},
                                         {420, {0.48, 0.10, 0.95}},
                                         {450, {0.20, 0.20, 1.00}},
                                         {475, {0.00, 0.45, 1.00}},
                                         {490, {0.00, 0.68, 0.92}},
                                         {510, {0.00, 0.78, 0.40}},
                                         {535, {0.30, 0.85, 0.05}},
                                         {565, {0.75, 0.88, 0.00}},
                                         {580, {1.00, 0.84, 0.00}},
                                         {600, {1.00, 0.60, 0.00}},
                                         {640, {0.98, 0.15, 0.05}},
                                         {780, {0.60, 0.00, 0.05}}}};
constexpr Rgb grey{0.55, 0.55, 0.55};

double linear(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); // IEC 61966-2-1
}
double encoded(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}
double luminance(Rgb const& c) {
    return 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
}

} // namespace

Rgb spectral_colour(double wavelength) {
    double const nm = wavelength * 1e9;
    if (!(nm >= spectrum.front().nm && nm <= spectrum.back().nm))
        return grey;
    auto const above = std::find_if(spectrum.begin() + 1, spectrum.end() - 1,
                                    [&](Node const& node) { return nm <= node.nm; });
    auto const below = above - 1;
    double const share = (nm - below->nm) / (above->nm - below->nm);
    Rgb colour{};
    for (std::size_t i = 0; i < 3; ++i)
        colour[i] = (1.0 - share) * below->colour[i] + share * above->colour[i];
    return colour;
}

Rgb on_white(Rgb colour) {
    constexpr double most =
        0.30; // luminance; contrast (1.05 / 0.35) of 3 : 1 with white, as WCAG 2.1 asks of graphics
    double const light = luminance(colour);
    if (light > most)
        for (double& c : colour)
            c = encoded(linear(c) * most / light);
    return colour;
}

Rgb on_black(Rgb colour) {
    constexpr double least = 0.15; // luminance; contrast (0.20 / 0.05) of 4 : 1 with black
    double const light = luminance(colour);
    if (light < least) {
        double const white = (least - light) / (1.0 - light);
        for (double& c : colour)
            c = encoded(linear(c) * (1.0 - white) + white);
    }
    return colour;
}

std::string hex(Rgb const& colour) {
    auto const byte = [&](std::size_t i) {
        return static_cast<unsigned>(std::lround(255.0 * std::clamp(colour[i], 0.0, 1.0)));
    };
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", byte(0) & 255U, byte(1) & 255U, byte(2) & 255U);
    return text.data();
}

} // namespace sahl::report

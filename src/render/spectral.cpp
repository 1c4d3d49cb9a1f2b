#include "render/spectral.h"

#include "materials/colour.h"
#include "optics/colour.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

constexpr double first_wavelength = 400e-9, last_wavelength = 700e-9; // beyond, the eye sees 0.4 % of D65

/// Linear sRGB of tristimulus values (IEC 61966-2-1), column by column.
dmat3 const srgb_of_xyz(dvec3(3.2406, -0.9689, 0.0557), dvec3(-1.5372, 1.8758, -0.2040),
                        dvec3(-0.4986, 0.0415, 1.0570));

std::size_t band_of(double wavelength) {
    return wavelength < blue_to_green ? 2 : wavelength < green_to_red ? 1 : 0;
}

/// What a line adds, unscaled: the colour of its light, from the number of its band alone.
dmat3 line_colour(double wavelength) {
    dmat3 colour(0.0);
    colour[static_cast<int>(band_of(wavelength))] =
        srgb_of_xyz * (illuminant_d65(wavelength) * colour_matching(wavelength));
    return colour;
}

} // namespace

dvec3 linear_srgb(dvec3 const& xyz) {
    return srgb_of_xyz * xyz;
}

Spectrum::Spectrum(std::uint32_t lines) {
    for (std::uint32_t i = 0; i < lines; ++i) {
        double const share = (i + 0.5) / lines;
        wavelengths_.push_back(first_wavelength + share * (last_wavelength - first_wavelength));
        colours_.push_back(line_colour(wavelengths_.back()));
    }
}

std::vector<Spectrum::Line> Spectrum::sample(std::uint32_t count, double turn) const {
    std::vector<Line> lines;
    auto const most = static_cast<std::uint32_t>(wavelengths_.size() - 1);
    double const all = most + 1.0;
    dmat3 sum(0.0);
    for (std::uint32_t i = 0; i < count; ++i) {
        auto const line = std::min(static_cast<std::uint32_t>((i + turn) / count * all), most);
        lines.push_back({line, colours_[line]});
        sum += colours_[line];
    }
    // the three numbers of what is seen stand for spectra that, unchanged, are seen as just these numbers
    dmat3 const to_bands = glm::inverse(sum);
    for (Line& line : lines)
        line.colour = line.colour * to_bands;
    return lines;
}

} // namespace sahl

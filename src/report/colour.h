// In: a wavelength. Out: a colour that reminds of it on a screen, for light and for dark pages.
#pragma once

#include <array>
#include <string>

namespace sahl::report {

/// sRGB components, each in [0, 1].
using Rgb = std::array<double, 3>;

/// The hue of light of one wavelength (m), at full strength, for the eye and not for colorimetry: a spectral
/// colour lies outside what a screen can show. Grey outside the visible range, 380 to 780 nm, and where it is
/// not finite.
Rgb spectral_colour(double wavelength);

/// The same hue, dark enough to be seen on white, or light enough to be seen on black.
Rgb on_white(Rgb colour);
Rgb on_black(Rgb colour);

/// "#rrggbb"
std::string hex(Rgb const& colour);

} // namespace sahl::report

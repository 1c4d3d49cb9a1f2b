// In: wavelengths and powers. Out: spectra of light, and the colour that a standard observer sees.
#pragma once

#include "math/vec.h"

namespace sahl {

/// Spectral power by Planck's law, up to a factor: λ⁻⁵ / (exp(c₂ / λT) − 1), c₂ = hc/k of CODATA 2018. The
/// 0.03 % between wavelengths in air and in vacuum are left out. wavelength   m, > 0; temperature   K, > 0
double black_body(double wavelength, double temperature);

/// Relative spectral power of the illuminant D65 (CIE 15:2004, table T.1, every 10 nm, linear in between as
/// the standard has it), 100 at 560 nm. wavelength in m; 0 outside 300 to 830 nm.
double illuminant_d65(double wavelength);

/// The colour-matching functions x̄, ȳ, z̄ of the CIE 1931 standard observer, 2° (CIE 15:2004, table T.4, every
/// 5 nm, linear in between). wavelength in m; 0 outside 380 to 780 nm.
dvec3 colour_matching(double wavelength);

/// Lumens in a watt at the top of ȳ (the definition of the candela).
inline constexpr double lumens_per_watt = 683.0;

/// sRGB (IEC 61966-2-1) of tristimulus values, of their colour alone: made as bright as it can be shown. What
/// lies outside the gamut is cut at 0. Each in [0, 1], with the standard's curve; black where there is no
/// light.
dvec3 srgb_of(dvec3 const& xyz);

} // namespace sahl

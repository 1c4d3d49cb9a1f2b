// In: a colour of three numbers, as model files give it. Out: what it is at one wavelength.
#pragma once

#include <array>

namespace sahl {

/// Linear red, green and blue shares, each in [0, 1].
using Colour = std::array<double, 3>;

// Where the bands of the sRGB primaries meet: a colour of three numbers says no more than what holds over
// red, green and blue light.
inline constexpr double blue_to_green = 490e-9; // m
inline constexpr double green_to_red = 580e-9;  // m

/// The number that holds at `wavelength` (m): blue below 490 nm, green below 580 nm, red above.
constexpr double at_wavelength(Colour const& colour, double wavelength) {
    return wavelength < blue_to_green ? colour[2] : wavelength < green_to_red ? colour[1] : colour[0];
}

} // namespace sahl

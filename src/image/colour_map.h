// In: a share of a scale. Out: a colour that everybody can tell apart from its neighbours, in sRGB.
#pragma once

#include <array>

namespace sahl {

using Colour = std::array<float, 3>; // red, green, blue, 0 … 1

/// The colour at `share` of viridis, clamped to [0, 1]; NaN is grey.
Colour colour_of(double share);

} // namespace sahl

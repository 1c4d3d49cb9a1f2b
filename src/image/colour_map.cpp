// In: a share of a scale. Out: its colour, linear between the stops of viridis.
#include "image/colour_map.h"

#include <algorithm>
#include <cmath>

namespace sahl {
namespace {

/// viridis by S. van der Walt and N. Smith (CC0), every fifteenth of its 256 colours.
constexpr std::array<Colour, 18> viridis{{{0.267F, 0.005F, 0.329F},
                                          {0.282F, 0.090F, 0.412F},
                                          {0.280F, 0.166F, 0.476F},
                                          {0.264F, 0.238F, 0.519F},
                                          {0.237F, 0.305F, 0.542F},
                                          {0.209F, 0.368F, 0.553F},
                                          {0.182F, 0.426F, 0.557F},
                                          {0.159F, 0.482F, 0.558F},
                                          {0.138F, 0.537F, 0.555F},
                                          {0.121F, 0.593F, 0.545F},
                                          {0.128F, 0.648F, 0.523F},
                                          {0.181F, 0.701F, 0.488F},
                                          {0.274F, 0.752F, 0.437F},
                                          {0.395F, 0.797F, 0.368F},
                                          {0.536F, 0.836F, 0.282F},
                                          {0.689F, 0.865F, 0.183F},
                                          {0.846F, 0.887F, 0.100F},
                                          {0.993F, 0.906F, 0.144F}}};

} // namespace

Colour colour_of(double share) {
    if (std::isnan(share))
        return {0.72F, 0.72F, 0.72F};
    double const place = std::clamp(share, 0.0, 1.0) * (viridis.size() - 1);
    std::size_t const below = std::min(static_cast<std::size_t>(place), viridis.size() - 2);
    auto const rest = static_cast<float>(place - static_cast<double>(below));
    Colour colour;
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] = viridis[below][c] + rest * (viridis[below + 1][c] - viridis[below][c]);
    return colour;
}

} // namespace sahl

// In: an angle of incidence and three indices. Out: the shares of power that a thin plane plate sends each
// way.
#pragma once

#include "optics/fresnel.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace sahl {

/// Shares of a plane plate between two media, its reflections to and fro summed without interference (each
/// power as often as it comes round), for s and p apart:
///   T = T1 T2 / (1 − R1 R2),   R = R1 + T1² R2 / (1 − R1 R2)
/// With the same medium on both sides R is R1 + T1² R1 / (1 − R1²) = 2 R1 / (1 + R1).
///   n_before, n_wall, n_after   > 0
/// Empty where a boundary reflects all, and so the plate does.
inline std::optional<FresnelShares> fresnel_plate(Incidence incidence, double n_before, double n_wall,
                                                  double n_after) {
    double const in_wall = transmitted_normal_squared(incidence, n_before, n_wall);
    double const beyond =
        transmitted_normal_squared(incidence, n_before, n_after); // (n cos)² there, by Snell
    if (in_wall <= 0.0 || beyond <= 0.0)
        return std::nullopt;
    FresnelShares const first = fresnel_shares(incidence, n_before, n_wall, std::sqrt(in_wall));
    Incidence const within{std::min(1.0, std::sqrt(in_wall) / n_wall),
                           std::min(1.0, incidence.sine * n_before / n_wall)};
    FresnelShares const second = fresnel_shares(within, n_wall, n_after, std::sqrt(beyond));
    auto const both = [](double r1, double t1, double r2, double t2) {
        double const round = 1.0 / (t1 + r1 * t2); // 1 − R1 R2 without cancellation
        return std::pair(r1 + t1 * t1 * r2 * round, t1 * t2 * round);
    };
    auto const [r_s, t_s] = both(first.r_s, first.t_s, second.r_s, second.t_s);
    auto const [r_p, t_p] = both(first.r_p, first.t_p, second.r_p, second.t_p);
    return FresnelShares{r_s, r_p, t_s, t_p};
}

} // namespace sahl

// In: dice. Out: inputs for the formulae of a boundary, regime by regime, and how far the formulae err there,
// judged by arithmetic of 113 bits: worst errors in ulp and absolute, decisions on total internal reflection,
// the balance R + T.
#pragma once

#include "optics/fresnel.h"
#include "optics/snell.h"
#include "support/dice.h"
#include "support/quad.h"
#include "torture/wide.h"

#include <algorithm>
#include <complex>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sahl::bench {

constexpr double unit_ulp = std::numeric_limits<double>::epsilon();

struct Worst {
    double ulps = 0.0; // of values whose error is above 1e-16
    double absolute = 0.0;

    void compare(double got, Quad expected) {
        double const error = static_cast<double>(absolute_of(Quad(got) - expected));
        absolute = std::max(absolute, std::isfinite(error) ? error : INFINITY);
        if (!(error <= 1e-16))
            ulps = std::max(ulps, error / (unit_ulp * std::abs(static_cast<double>(expected))));
    }
};

struct Shares4 {
    Worst r_s, r_p, t_s, t_p;
    double balance = 0.0; // |R + T − 1| for s, p and unpolarised light
    std::uint64_t inputs = 0, wrong_total = 0;

    void compare(FresnelShares const& got, ExactShares const& exact) {
        r_s.compare(got.r_s, exact.r_s);
        r_p.compare(got.r_p, exact.r_p);
        t_s.compare(got.t_s, exact.t_s);
        t_p.compare(got.t_p, exact.t_p);
        balance = std::max({balance, std::abs(got.r_s + got.t_s - 1.0), std::abs(got.r_p + got.t_p - 1.0),
                            std::abs(got.reflectance() + got.transmittance() - 1.0)});
    }
    double ulps() const { return std::max({r_s.ulps, r_p.ulps, t_s.ulps, t_p.ulps}); }
    double absolute() const { return std::max({r_s.absolute, r_p.absolute, t_s.absolute, t_p.absolute}); }
};

struct Meeting2 { // of a ray and a boundary
    Incidence incidence;
    double n1, n2;
};

struct Regime {
    std::string name;
    std::function<Meeting2(Dice&)> draw;
    bool near_critical = false;
};

inline Incidence at_angle(double a) {
    return {std::cos(a), std::sin(a)};
}
inline Incidence at_grazing(double g) {
    return {std::sin(g), std::cos(g)};
}

/// From everywhere, and from where a sign, a square root or a difference of nearly equal numbers decides.
inline std::vector<Regime> dielectric_regimes() {
    auto const index = [](Dice& d) { return d.between(1.0, 4.0); };
    auto const away = [](Meeting2 const& m) {
        return m.n1 <= m.n2 ||
               std::abs(std::atan2(m.incidence.sine, m.incidence.cosine) - std::asin(m.n2 / m.n1)) > 1e-3;
    };
    return {
        {"any angle, 1e-3 rad and more from the critical one",
         [=](Dice& d) {
             for (;;) {
                 double const n1 = index(d), n2 = index(d);
                 Meeting2 const m{at_angle(d.between(0.0, std::numbers::pi / 2)), n1, n2};
                 if (away(m))
                     return m;
             }
         }},
        {"1e-3 … 1e-6 rad from the critical angle",
         [=](Dice& d) {
             double const critical = d.between(0.02, 1.55), n1 = index(d), n2 = n1 * std::sin(critical);
             return Meeting2{at_angle(std::asin(n2 / n1) + d.sign() * d.log_between(1e-6, 1e-3)), n1, n2};
         },
         true},
        {"1e-6 … 1e-17 rad from the critical angle",
         [=](Dice& d) {
             double const critical =
                 d.below(2) ? d.between(0.02, 1.57) : std::numbers::pi / 2 - d.log_between(1e-6, 1.0);
             double const n1 = index(d), n2 = n1 * std::sin(critical);
             return Meeting2{at_angle(std::asin(n2 / n1) + d.sign() * d.log_between(1e-17, 1e-6)), n1, n2};
         },
         true},
        {"grazing, 1e-2 … 1e-300 rad",
         [=](Dice& d) {
             double const n1 = index(d);
             return Meeting2{at_grazing(d.log_between(1e-300, 1e-2)), n1, n1 + d.log_between(0.01, 3.0)};
         }},
        {"normal, 0 … 1e-2 rad",
         [=](Dice& d) {
             return Meeting2{at_angle(d.below(10) ? d.log_between(1e-300, 1e-2) : 0.0), index(d), index(d)};
         }},
        {"Brewster's angle to 1e-3 … 1e-17 rad",
         [=](Dice& d) {
             double const n1 = index(d), n2 = index(d);
             return Meeting2{at_angle(std::atan(n2 / n1) + d.sign() * d.log_between(1e-17, 1e-3)), n1, n2};
         }},
        {"indices that differ by 1e-3 … 1e-16, into the denser",
         [=](Dice& d) {
             double const n1 = index(d);
             return Meeting2{at_angle(d.between(0.0, 1.57)), n1, n1 * (1.0 + d.log_between(1e-16, 1e-3))};
         }},
        {"the same, grazing at 1e-1 … 1e-12 rad",
         [=](Dice& d) {
             double const n1 = index(d);
             return Meeting2{at_grazing(d.log_between(1e-12, 0.1)), n1,
                             n1 * (1.0 + d.log_between(1e-16, 1e-3))};
         }},
        {"45°, where the formula changes",
         [=](Dice& d) {
             double const n1 = index(d), n2 = std::max(index(d), 0.75 * n1);
             return Meeting2{at_angle(std::numbers::pi / 4 + d.sign() * d.log_between(1e-17, 1e-3)), n1, n2};
         }},
    };
}

inline Shares4 judge_dielectric(Regime const& regime, std::uint64_t seed, std::uint64_t inputs) {
    Shares4 worst;
    Dice dice(seed);
    for (; worst.inputs < inputs; ++worst.inputs) {
        Meeting2 const m = regime.draw(dice);
        auto const got = fresnel_dielectric(m.incidence, m.n1, m.n2);
        auto const exact = exact_fresnel(m.incidence, m.n1, m.n2);
        worst.wrong_total += got.has_value() != exact.has_value();
        if (got && exact)
            worst.compare(*got, *exact);
    }
    return worst;
}

struct MetalMeeting {
    Incidence incidence;
    double n1;
    std::complex<double> metal;
};

struct MetalRegime {
    std::string name;
    std::function<MetalMeeting(Dice&)> draw;
    bool near_critical = false;
};

inline std::vector<MetalRegime> metal_regimes() {
    auto const any = [](Dice& d) {
        return std::complex<double>{d.log_between(0.01, 10.0), d.log_between(0.1, 20.0)};
    };
    auto const thin = [](Dice& d) {
        double const n1 = d.between(1.0, 3.0);
        return MetalMeeting{
            at_angle(d.between(0.0, 1.5707)), n1, {n1 * d.log_between(0.1, 0.9), d.log_between(1e-3, 0.1)}};
    };
    return {
        {"metals, any angle",
         [=](Dice& d) {
             return MetalMeeting{at_angle(d.between(0.0, 1.5707)), d.between(1.0, 3.0), any(d)};
         }},
        {"metals, grazing at 1e-1 … 1e-300 rad",
         [=](Dice& d) {
             return MetalMeeting{at_grazing(d.log_between(1e-300, 0.1)), d.between(1.0, 3.0), any(d)};
         }},
        {"metals, normal",
         [=](Dice& d) {
             return MetalMeeting{at_angle(d.log_between(1e-300, 1e-2)), d.between(1.0, 3.0), any(d)};
         }},
        {"nearly transparent, k 1e-1 … 1e-12",
         [=](Dice& d) {
             double const n1 = d.between(1.0, 3.0);
             return MetalMeeting{
                 at_angle(d.between(0.0, 1.5)), n1, {n1 * d.between(1.0, 2.0), d.log_between(1e-12, 0.1)}};
         }},
        {"nearly transparent, n below the medium's, away from the critical angle",
         [=](Dice& d) {
             for (;;) {
                 MetalMeeting const m = thin(d);
                 double const n = m.metal.real() / m.n1;
                 if (std::abs(n * n - m.incidence.sine * m.incidence.sine) > 0.05)
                     return m;
             }
         }},
        {"nearly transparent, n below the medium's, near the critical angle",
         [=](Dice& d) {
             MetalMeeting m = thin(d);
             m.incidence = at_angle(std::asin(m.metal.real() / m.n1) + d.sign() * d.log_between(1e-17, 1e-2));
             return m;
         },
         true},
        {"nearly matched, n to 1e-2 … 1e-12, k the same",
         [=](Dice& d) {
             double const n1 = d.between(1.0, 3.0);
             return MetalMeeting{at_angle(d.between(0.0, 1.5)),
                                 n1,
                                 {n1 * (1.0 + d.log_between(1e-12, 1e-2)), n1 * d.log_between(1e-12, 1e-2)}};
         }},
        {"nearly perfect, k to 1e4",
         [=](Dice& d) {
             return MetalMeeting{at_angle(d.between(0.0, 1.5707)),
                                 d.between(1.0, 3.0),
                                 {d.log_between(1e-3, 10.0), d.log_between(10.0, 1e4)}};
         }},
    };
}

inline Shares4 judge_metal(MetalRegime const& regime, std::uint64_t seed, std::uint64_t inputs) {
    Shares4 worst;
    Dice dice(seed);
    for (; worst.inputs < inputs; ++worst.inputs) {
        MetalMeeting const m = regime.draw(dice);
        worst.compare(fresnel_metal(m.incidence, m.n1, m.metal), exact_metal(m.incidence, m.n1, m.metal));
    }
    return worst;
}

struct Directions {
    double refracted = 0.0, reflected = 0.0; // rad, the worst error; inputs are taken as unit vectors
    double length = 0.0;                     // of either, from 1
    double undecided =
        0.0; // |k2²| / n1², the largest at which the decision on total internal reflection was wrong
    std::uint64_t inputs = 0;
};

/// The same regimes, with the incidence made from two vectors in space, whose rounding is that of the inputs.
inline Directions judge_directions(Regime const& regime, std::uint64_t seed, std::uint64_t inputs) {
    using Q3 = Wide3<Quad>;
    Directions worst;
    Dice dice(seed);
    for (; worst.inputs < inputs; ++worst.inputs) {
        Meeting2 const m = regime.draw(dice);
        dvec3 const normal = dice.direction();
        dvec3 const d = normalize(m.incidence.sine * perpendicular_to(normal, dice.direction()) -
                                  m.incidence.cosine * normal);
        if (dot(d, normal) > 0.0)
            continue;
        Q3 const wide_d = normalize(Q3(d)), wide_n = normalize(Q3(normal));
        Quad const cosine = -dot(wide_d, wide_n), n1 = m.n1, n2 = m.n2;
        Q3 const along = wide_d + cosine * wide_n;
        auto const err = [&](dvec3 const& got, Q3 const& exact) {
            worst.length = std::max(worst.length, std::abs(static_cast<double>(length(Q3(got)) - 1)));
            return static_cast<double>(length(cross(Q3(got), exact)));
        };
        worst.reflected = std::max(worst.reflected, err(reflect(d, normal), along + cosine * wide_n));
        Quad const squared = n2 * n2 - n1 * n1 * dot(along, along);
        auto const got = refract(d, normal, m.n1, m.n2);
        if (got.has_value() != (squared > 0)) {
            worst.undecided =
                std::max(worst.undecided, static_cast<double>(absolute_of(squared) / (n1 * n1)));
            continue;
        }
        if (got)
            worst.refracted =
                std::max(worst.refracted, err(*got, (n1 / n2) * along - (root_of(squared) / n2) * wide_n));
    }
    return worst;
}

} // namespace sahl::bench

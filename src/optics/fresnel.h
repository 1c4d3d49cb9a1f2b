// In: an angle of incidence and the indices on both sides. Out: the shares of power that go each way, for s
// and p. Source: M. Born, E. Wolf, Principles of Optics, 7th ed., 1.5.2 (dielectrics), 14.2 (metals).
#pragma once

#include "math/products.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

namespace sahl {

/// Shares of the incident power, each in [0, 1], for s (perpendicular) and p (parallel to the plane of
/// incidence).
struct FresnelShares {
    double r_s, r_p, t_s, t_p;
    double reflectance() const { return 0.5 * (r_s + r_p); }   // unpolarised light
    double transmittance() const { return 0.5 * (t_s + t_p); } // unpolarised light
};

/// An angle of incidence as the pair (cosine, sine), so that neither end of the range loses digits.
struct Incidence {
    double cosine; // [0, 1]
    double sine;   // [0, 1]
};

/// (n_transmitted cos t)² = n_t² − n_i² sin² i, formed without cancellation; ≤ 0 is total internal
/// reflection.
inline double transmitted_normal_squared(Incidence incidence, double n_incident, double n_transmitted) {
    auto const [cosine, sine] = incidence;
    if (cosine >= sine) // small angles: n_t ± n_i sin are formed with one rounding each
        return std::fma(-n_incident, sine, n_transmitted) * std::fma(n_incident, sine, n_transmitted);
    // near grazing: n_t² − n_i² + (n_i cos)², both with what rounding took from them, since near the critical
    // angle they cancel
    double const along = n_incident * cosine;
    double const along_error = std::fma(n_incident, cosine, -along);
    double const difference = n_transmitted - n_incident; // exact there: n_i < √2 n_t
    double const sum = n_transmitted + n_incident;
    double const sum_error =
        std::min(n_incident, n_transmitted) - (sum - std::max(n_incident, n_transmitted));
    double const indices = difference * sum;
    double const indices_error = std::fma(difference, sum, -indices) + difference * sum_error;
    return std::fma(along, along, indices) + (2.0 * along * along_error + indices_error);
}

/// Shares at a smooth boundary between two dielectrics; t_s, t_p are computed, not taken as 1 − r.
///   n_incident, n_transmitted   > 0, at the ray's wavelength
///   transmitted_normal          > 0, √ of transmitted_normal_squared()
inline FresnelShares fresnel_shares(Incidence incidence, double n_incident, double n_transmitted,
                                    double transmitted_normal) {
    auto const [c, s] = incidence;
    double const n1 = n_incident, n2 = n_transmitted;
    double const n1_squared = n1 * n1, n2_squared = n2 * n2;
    double const k1 = n1 * c, k2 = transmitted_normal;
    double const indices = (n2 - n1) * (n2 + n1);
    double const by_sum_s = 1.0 / (k1 + k2);
    double const by_sum_p = 1.0 / (n2_squared * k1 + n1_squared * k2);
    // the difference itself where little cancels, so that near R = 1 what is reflected and what is
    // transmitted add up
    double const difference_s = k1 - k2, difference_p = n2_squared * k1 - n1_squared * k2;
    double const amplitude_s =
        by_sum_s * (std::abs(difference_s) * by_sum_s > 0.5 ? difference_s : indices * by_sum_s);
    // n2² c² − n1² s²; where s is the small one and has the digits, this is k2² − n2² s²
    double const along = n2 * s;
    double const difference = c >= s ? std::fma(k2, k2, -along * along)
                                     : difference_of_products(n2, c, n1, s) * std::fma(n2, c, n1 * s);
    double const amplitude_p =
        by_sum_p * (std::abs(difference_p) * by_sum_p > 0.5 ? difference_p
                                                            : indices * n1_squared * difference * by_sum_p);
    double const both = 4.0 * k1 * k2;
    return {amplitude_s * amplitude_s, amplitude_p * amplitude_p, both * by_sum_s * by_sum_s,
            both * n1_squared * n2_squared * by_sum_p * by_sum_p};
}

/// The same from the indices alone. Empty is total internal reflection.
inline std::optional<FresnelShares> fresnel_dielectric(Incidence incidence, double n_incident,
                                                       double n_transmitted) {
    double const squared = transmitted_normal_squared(incidence, n_incident, n_transmitted);
    if (squared <= 0.0)
        return std::nullopt;
    return fresnel_shares(incidence, n_incident, n_transmitted, std::sqrt(squared));
}

/// Reflected and absorbed shares at a smooth metal of complex index n + ik (k ≥ 0) seen from a dielectric of
/// index n_incident > 0; t_s and t_p are the shares that the metal absorbs, computed, not taken as 1 − r.
FresnelShares fresnel_metal(Incidence incidence, double n_incident, std::complex<double> metal);

} // namespace sahl

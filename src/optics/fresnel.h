// In: an angle of incidence and the indices on both sides. Out: the shares of power that go each way, for s and p.
// Source: M. Born, E. Wolf, Principles of Optics, 7th ed., 1.5.2 (dielectrics), 14.2 (metals).
#pragma once

#include <complex>
#include <optional>

namespace sahl {

/// Shares of the incident power, each in [0, 1], for s (perpendicular) and p (parallel to the plane of incidence).
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

/// (n_transmitted cos t)² = n_t² − n_i² sin² i, formed without cancellation; ≤ 0 is total internal reflection.
double transmitted_normal_squared(Incidence incidence, double n_incident, double n_transmitted);

/// Shares at a smooth boundary between two dielectrics; t_s, t_p are computed, not taken as 1 − r.
/// Empty is total internal reflection.
///   n_incident, n_transmitted   > 0, at the ray's wavelength
std::optional<FresnelShares> fresnel_dielectric(Incidence incidence, double n_incident, double n_transmitted);

/// Reflected and absorbed shares at a smooth metal of complex index n + ik (k ≥ 0) seen from a dielectric of index
/// n_incident > 0; t_s and t_p are the shares that the metal absorbs, computed, not taken as 1 − r.
FresnelShares fresnel_metal(Incidence incidence, double n_incident, std::complex<double> metal);

} // namespace sahl

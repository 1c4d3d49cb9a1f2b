// In: polarised light, an angle of incidence, the indices on both sides. Out: the share of the power that
// goes each way, and how that is polarised then. Source: M. Born, E. Wolf, Principles of Optics, 7th ed.,
// 1.4.2 (Stokes), 1.5.2 to 1.5.4 (dielectrics, total reflection), 14.2 (metals).
#pragma once

#include "math/vec.h"
#include "optics/fresnel.h"

#include <algorithm>
#include <complex>
#include <optional>

namespace sahl {

/// The state of light that travels along a direction, whatever its power: Stokes' S1, S2, S3 over S0, of
/// length ≤ 1. S1 is positive along `axis`, S2 halfway between it and direction × axis, S3 if right-handed
/// seen by the receiver.
struct PolarisedLight {
    dvec3 axis{0.0}; // unit, ⟂ direction
    dvec3 stokes{0.0};
};

/// The same light, told by another axis.
///   direction, axis   unit, at right angles
PolarisedLight told_by(PolarisedLight const& light, dvec3 const& direction, dvec3 const& axis);

/// What a smooth surface does to light on one of the ways that leave it: shares of the power for s and p, and
/// a_s a_p* of the amplitudes, with p = direction × s on every way, times exp(−iωt). Of light that takes one
/// way by several mechanisms that do not interfere, the sum.
struct Sorting {
    double s = 0.0, p = 0.0;
    std::complex<double> pair{0.0, 0.0};

    /// Of light whose axis is s: the share of its power.
    double share(dvec3 const& stokes) const { return 0.5 * (of_s(stokes) + of_p(stokes)); }
    /// What that is like then, its axis s too; unpolarised where there is none.
    dvec3 stokes_after(dvec3 const& stokes) const;

  private:
    double of_s(dvec3 const& stokes) const { return s * std::max(0.0, 1.0 + stokes.x); }
    double of_p(dvec3 const& stokes) const { return p * std::max(0.0, 1.0 - stokes.x); }
};

inline Sorting operator+(Sorting const& a, Sorting const& b) {
    return {a.s + b.s, a.p + b.p, a.pair + b.pair};
}
inline Sorting operator*(double share, Sorting const& sorting) {
    return {share * sorting.s, share * sorting.p, share * sorting.pair};
}

/// Ways that leave a surface, and the shares that stay in it.
struct SortedWays {
    std::optional<Sorting> through; // nothing under total reflection
    Sorting back;
    double absorbed_s = 0.0, absorbed_p = 0.0;
};

inline constexpr Sorting lets_pass{1.0, 1.0, {1.0, 0.0}};
inline constexpr Sorting ideal_mirror{1.0, 1.0, {-1.0, 0.0}}; // the tangential field turns over

/// A smooth boundary between two dielectrics. Totally reflected, s and p part by a phase:
///   tan(½ phase) = cos i √(n_i² sin² i − n_t²) / (n_i sin² i)
///   n_incident, n_transmitted   > 0, at the ray's wavelength
SortedWays sorted_by_dielectric(Incidence incidence, double n_incident, double n_transmitted);

/// A smooth metal, as fresnel_metal() has it.
SortedWays sorted_by_metal(Incidence incidence, double n_incident, std::complex<double> metal);

/// A plane plate, as fresnel_plate() has it: reflections to and fro do not interfere.
SortedWays sorted_by_plate(Incidence incidence, double n_before, double n_wall, double n_after);

} // namespace sahl

#include "optics/polarisation.h"

#include "optics/plate.h"

#include <algorithm>
#include <cmath>

namespace sahl {

using Complex = std::complex<double>;

namespace {

/// r_s r_p: both are of one sign beyond Brewster's angle, n_t cos i < n_i sin i, alone.
double reflected_pair(FresnelShares const& shares, Incidence incidence, double n_incident,
                      double n_transmitted) {
    double const size = std::sqrt(shares.r_s * shares.r_p);
    return n_transmitted * incidence.cosine > n_incident * incidence.sine ? -size : size;
}

double transmitted_pair(FresnelShares const& shares) {
    return std::sqrt(shares.t_s * shares.t_p);
}

/// (a − ib) / (a + ib): of modulus 1.
Complex turned_back(double a, double b) {
    return Complex(a, -b) / Complex(a, b);
}

} // namespace

PolarisedLight told_by(PolarisedLight const& light, dvec3 const& direction, dvec3 const& axis) {
    // the angle from one axis to the other, about the direction, comes in twice
    double const along = dot(axis, light.axis), across = dot(axis, cross(direction, light.axis));
    double const size = along * along + across * across;
    double const cosine = (along * along - across * across) / size, sine = 2.0 * along * across / size;
    dvec3 const& s = light.stokes;
    return {axis, {cosine * s.x + sine * s.y, cosine * s.y - sine * s.x, s.z}};
}

dvec3 Sorting::stokes_after(dvec3 const& stokes) const {
    double const power = share(stokes);
    if (power <= 0.0)
        return dvec3(0.0);
    Complex const across = pair * Complex(stokes.y, stokes.z);
    return dvec3(0.5 * (of_s(stokes) - of_p(stokes)), across.real(), across.imag()) / power;
}

SortedWays sorted_by_dielectric(Incidence incidence, double n_incident, double n_transmitted) {
    double const squared = transmitted_normal_squared(incidence, n_incident, n_transmitted);
    if (squared <= 0.0) {
        double const along = n_incident * incidence.cosine, decay = std::sqrt(-squared);
        Complex const r_s = turned_back(along, decay);
        Complex const r_p =
            turned_back(n_transmitted * n_transmitted * along, n_incident * n_incident * decay);
        return {std::nullopt, {1.0, 1.0, r_s * std::conj(r_p)}};
    }
    FresnelShares const shares = fresnel_shares(incidence, n_incident, n_transmitted, std::sqrt(squared));
    return {Sorting{shares.t_s, shares.t_p, transmitted_pair(shares)},
            {shares.r_s, shares.r_p, reflected_pair(shares, incidence, n_incident, n_transmitted)}};
}

SortedWays sorted_by_metal(Incidence incidence, double n_incident, std::complex<double> metal) {
    FresnelShares const shares = fresnel_metal(incidence, n_incident, metal);
    Complex const index = metal / n_incident, epsilon = index * index;
    Complex const q = std::sqrt(epsilon - incidence.sine * incidence.sine);
    Complex const c = incidence.cosine;
    Complex const r_s = (c - q) / (c + q), r_p = (epsilon * c - q) / (epsilon * c + q);
    return {Sorting{}, {shares.r_s, shares.r_p, r_s * std::conj(r_p)}, shares.t_s, shares.t_p};
}

SortedWays sorted_by_plate(Incidence incidence, double n_before, double n_wall, double n_after) {
    SortedWays const first = sorted_by_dielectric(incidence, n_before, n_wall);
    if (!first.through)
        return first;
    double const cosine = std::sqrt(transmitted_normal_squared(incidence, n_before, n_wall)) / n_wall;
    Incidence const within{std::min(1.0, cosine), std::min(1.0, incidence.sine * n_before / n_wall)};
    SortedWays const second = sorted_by_dielectric(within, n_wall, n_after);
    // seen from within, the first surface pairs s and p as it does from before
    Complex const t1 = first.through->pair, r1 = first.back.pair, r2 = second.back.pair;
    Complex const round = 1.0 / (1.0 - r1 * r2);
    auto const plate = fresnel_plate(incidence, n_before, n_wall, n_after);
    if (!plate || !second.through)
        return {std::nullopt, {1.0, 1.0, r1 + t1 * t1 * r2 * round}};
    return {Sorting{plate->t_s, plate->t_p, t1 * second.through->pair * round},
            {plate->r_s, plate->r_p, r1 + t1 * t1 * r2 * round}};
}

} // namespace sahl

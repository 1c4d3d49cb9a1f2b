// In: a triangle, the directions in which heights over it are measured, and what is known of its surface.
// Out: the surface's place, tangents and normal at weights of its corners, and where a line meets it steeply.
#pragma once

#include "math/vec.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

namespace sahl {

/// x = Σ w_k p_k + H(w) Σ w_k up_k, with H of degree 4 in the weights of the corners. Two triangles that
/// share a side share what H and `up` are on it, to the bit: they leave no gap. Four lines of a cache, float
/// where heights and tilts are a small share of what is measured.
struct alignas(64) Patch {
    /// Bernstein's coefficients, rows by the third corner's exponent, in each the second's.
    template <std::size_t Degree>
    using Net = std::array<float, (Degree + 1) * (Degree + 2) / 2>;

    dvec3 corner{0.0}, to_second{0.0}, to_third{0.0}; // the first corner, and from there
    std::array<std::array<float, 3>, 3> up{};         // about unit
    Net<4> height{};                                  // m
    Net<3> tilt_second{}, tilt_third{};               // m: the normal for light runs along
                                                      // to_second × to_third + Σ tilt · to_…
    enum Made : std::uint32_t { bare, even, uneven };
    std::atomic<Made> made{bare}; // heights and tilts are there; uneven: far from the quadratic surface,
                                  // or in a cell that leans much
    bool flat = false;            // to rounding: where it is does not hang on what was fitted
    bool stood_in = false;        // the quadratic surface is there in part, where what was fitted strays

    dvec3 direction(std::size_t k) const {
        return {static_cast<double>(up[k][0]), static_cast<double>(up[k][1]), static_cast<double>(up[k][2])};
    }
    dvec3 place(std::size_t k) const { return k == 0 ? corner : corner + (k == 1 ? to_second : to_third); }
    void prefetch() const {
        auto const* const line = reinterpret_cast<char const*>(this);
        for (std::size_t at = 0; at < sizeof(Patch); at += 64)
            __builtin_prefetch(line + at);
    }
};
static_assert(sizeof(Patch) == 256);

/// Bernstein's polynomials of degree 3, in the order of a net.
inline std::array<double, 10> cubic_basis(double v, double w) {
    double const u = 1.0 - v - w, uu = u * u, vv = v * v, ww = w * w, three_u = 3.0 * u, three_v = 3.0 * v;
    return {uu * u,          three_u * u * v, three_u * vv, vv * v,       3.0 * uu * w,
            6.0 * u * v * w, three_v * v * w, three_u * ww, three_v * ww, ww * w};
}

inline double sum_of(std::array<float, 10> const& net, std::array<double, 10> const& basis) {
    double even = 0.0, odd = 0.0; // two chains, for speed
    for (std::size_t n = 0; n < net.size(); n += 2) {
        even += basis[n] * static_cast<double>(net[n]);
        odd += basis[n + 1] * static_cast<double>(net[n + 1]);
    }
    return even + odd;
}

/// Of a polynomial: its value and how it changes with the second and third weight.
struct NetValue {
    double value = 0.0, by_v = 0.0, by_w = 0.0;
};

/// What de Casteljau's first three steps leave, and his last one.
inline NetValue value_of(std::array<float, 15> const& net, double v, double w) {
    std::array<double, 10> const basis = cubic_basis(v, w);
    double first = 0.0, second = 0.0, third = 0.0;
    std::size_t n = 0, here = 0;
    for (std::size_t k = 0; k < 4; ++k) { // rows of the basis; the net's are longer by one
        std::size_t const next_row = here + 5 - k;
        for (std::size_t j = 0; j + k < 4; ++j, ++n) {
            first += basis[n] * static_cast<double>(net[here + j]);
            second += basis[n] * static_cast<double>(net[here + j + 1]);
            third += basis[n] * static_cast<double>(net[next_row + j]);
        }
        here = next_row;
    }
    return {(1.0 - v - w) * first + v * second + w * third, 4.0 * (second - first), 4.0 * (third - first)};
}

/// The surface at weights of the second and third corner.
struct PatchPoint {
    dvec3 place{0.0}, by_v{0.0}, by_w{0.0};
    double height = 0.0;
    dvec3 outward() const { return cross(by_v, by_w); } // not unit
};

[[gnu::always_inline]] inline PatchPoint point_on(Patch const& patch, double v, double w) {
    NetValue const h = value_of(patch.height, v, w);
    dvec3 const first = patch.direction(0), second = patch.direction(1) - first,
                third = patch.direction(2) - first;
    dvec3 const up = first + v * second + w * third;
    return {patch.corner + v * patch.to_second + w * patch.to_third + h.value * up,
            patch.to_second + h.value * second + h.by_v * up, patch.to_third + h.value * third + h.by_w * up,
            h.value};
}

/// The normal for light, not unit.
inline dvec3 light_normal(Patch const& patch, double v, double w) {
    std::array<double, 10> const basis = cubic_basis(v, w);
    return cross(patch.to_second, patch.to_third) + sum_of(patch.tilt_second, basis) * patch.to_second +
           sum_of(patch.tilt_third, basis) * patch.to_third;
}

/// Where a line meets a patch, or the patch's own continuation beside it.
struct PatchMeeting {
    double t = 0.0, v = 0.0, w = 0.0;
    dvec3 outward{0.0}; // not unit
};

/// By Newton's method from where the line meets the triangle; for lines that are steep to all of the patch.
/// Nothing where it does not settle.
///   size    m: heights change by no more than this over a patch
///   error   m: of the place, along the normal
std::optional<PatchMeeting> meet_steeply(Patch const& patch, dvec3 const& origin, dvec3 const& direction,
                                         double size, double error);

} // namespace sahl

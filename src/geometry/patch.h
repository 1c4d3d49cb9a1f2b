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
    std::atomic<std::uint32_t> made{0};               // heights and tilts are there

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

/// Of a polynomial in Bernstein's form: its value and how it changes with the second and third weight.
struct NetValue {
    double value = 0.0, by_v = 0.0, by_w = 0.0;
};

/// By de Casteljau's steps; equal where two nets agree along a side.
template <std::size_t Degree, std::size_t Size>
NetValue value_of(std::array<float, Size> const& net, double v, double w) {
    static_assert(Size == (Degree + 1) * (Degree + 2) / 2);
    double const u = 1.0 - v - w;
    std::array<double, Size> b;
    for (std::size_t i = 0; i < Size; ++i)
        b[i] = static_cast<double>(net[i]);
    for (std::size_t degree = Degree; degree > 1; --degree) {
        std::size_t to = 0, row = 0;
        for (std::size_t k = 0; k < degree; ++k) {
            std::size_t const length = degree + 1 - k;
            for (std::size_t j = 0; j + 1 < length; ++j)
                b[to++] = u * b[row + j] + v * b[row + j + 1] + w * b[row + length + j];
            row += length;
        }
    }
    constexpr auto degree = static_cast<double>(Degree);
    return {u * b[0] + v * b[1] + w * b[2], degree * (b[1] - b[0]), degree * (b[2] - b[0])};
}

/// The surface at weights of the second and third corner.
struct PatchPoint {
    dvec3 place{0.0}, by_v{0.0}, by_w{0.0};
    double height = 0.0;
    dvec3 outward() const { return cross(by_v, by_w); } // not unit
};

inline PatchPoint point_on(Patch const& patch, double v, double w) {
    NetValue const h = value_of<4>(patch.height, v, w);
    dvec3 const first = patch.direction(0), second = patch.direction(1) - first,
                third = patch.direction(2) - first;
    dvec3 const up = first + v * second + w * third;
    return {patch.corner + v * patch.to_second + w * patch.to_third + h.value * up,
            patch.to_second + h.value * second + h.by_v * up, patch.to_third + h.value * third + h.by_w * up,
            h.value};
}

/// The normal for light, not unit.
inline dvec3 light_normal(Patch const& patch, double v, double w) {
    return cross(patch.to_second, patch.to_third) +
           value_of<3>(patch.tilt_second, v, w).value * patch.to_second +
           value_of<3>(patch.tilt_third, v, w).value * patch.to_third;
}

/// Where a line meets a patch, or the patch's own continuation beside it.
struct PatchMeeting {
    double t = 0.0, v = 0.0, w = 0.0;
    dvec3 outward{0.0}; // not unit
};

/// By Newton's method from where the line meets the triangle; for lines that are steep to all of the patch.
/// Nothing where it does not settle.
std::optional<PatchMeeting> meet_steeply(Patch const& patch, dvec3 const& origin, dvec3 const& direction);

} // namespace sahl

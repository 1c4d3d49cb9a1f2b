// In: smooth fans. Out: how far the curved surface may rise over each triangle, which sides keep to the chord
// because no surface over them can be trusted, and a cage of triangles that the surface does not leave.
#pragma once

#include "geometry/embree/box_tree.h"
#include "geometry/patch.h"
#include "geometry/smooth_fans.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sahl {

/// What a triangle's surface keeps to, known before anything is fitted.
struct Relief {
    std::array<float, 3> bulge{}; // m: over the side opposite corner k the quadratic surface rises to u(1−u)
                                  // times this; 0 over a chord
    std::array<float, 3> room{};   // m: and another surface may differ from it by this
    float low = 0.0f, high = 0.0f; // m: heights along `up` lie between these
    std::uint8_t chords = 0;       // bit k: the side opposite corner k is a crease or not to be trusted

    double bulge_over(std::size_t k) const { return static_cast<double>(bulge[k]); }
    bool has_chord(std::size_t k) const { return (chords >> k & 1) != 0; }
    /// Height of the quadratic surface.
    double model(double v, double w) const {
        double const u = 1.0 - v - w;
        return v * w * bulge_over(0) + u * w * bulge_over(1) + u * v * bulge_over(2);
    }
};

/// Patches with corners and `up` alone.
std::unique_ptr<Patch[]> bare_patches(SmoothFans const& fans);

std::vector<Relief> reliefs_of(SmoothFans const& fans, std::span<Patch const> patches);

Bounds box_of(Patch const& patch, Relief const& relief);

/// A line that meets the surface crosses the cage: within `thickness` along its normal where it is steep to
/// the cage, and there alone; or it crosses it at a slope below `steep`, or a triangle of `doubtful`.
struct PatchCage {
    static constexpr std::uint32_t doubtful = 0x80000000u;
    std::vector<std::array<dvec3, 3>> triangles;
    std::vector<std::uint32_t> owner; // the triangle whose patch is there, with `doubtful`
    double steep = 0.0;               // slope
    double thickness = 0.0;           // m
};

PatchCage cage_of(SmoothFans const& fans, std::span<Patch const> patches, std::span<Relief const> reliefs);

} // namespace sahl

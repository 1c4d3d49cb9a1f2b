// In: nothing. Out: what a way of finding the next hit must be able to do to be followed through the torture
// suite.
#pragma once

#include "torture/scene.h"

#include <memory>

namespace sahl::bench {

/// What a method says comes next.
struct Answer {
    enum class Kind { boundary, nothing, lost } kind = Kind::nothing;
    double t = 0.0;
    std::uint32_t part = 0, face = 0;    // of a mesh: the triangle
    dvec3 normal{0.0};                   // unit, either way round
    std::uint32_t before = 0, after = 0; // media
    bool mirror = false;                 // it reflects, whatever the media
};

/// Follows one ray at a time: begin; next, go_on; next, go_on …
class Finder {
  public:
    virtual ~Finder() = default;
    /// A ray in free space, or on the surface of a part. Which bodies it is in is told, by those that contain
    /// it, but a method may find out by itself.
    virtual void begin(TortureRay const& ray, std::vector<std::uint32_t> const& inside) = 0;
    virtual Answer next() = 0;
    /// From the place that next() found.
    virtual void go_on(dvec3 const& direction, bool crosses) = 0;
    /// The medium and the line that it follows now, as it holds them.
    virtual std::uint32_t medium() const = 0;
    virtual dvec3 origin() const = 0;
    virtual dvec3 direction() const = 0;
    /// Relative rounding of its coordinates: ulp of 1 in its arithmetic.
    virtual double ulp() const = 0;
};

} // namespace sahl::bench

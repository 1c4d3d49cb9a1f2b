// In: what a path meets. Out: how far rounding may have moved it by then, carried along as a covariance of
// place and direction to first order, which every interaction stretches, and adds a rounding of its own to.
#pragma once

#include "geometry/bvh.h"
#include "trace/event.h"

#include <array>
#include <cstdint>

namespace sahl {

/// What a path is turned by: the surface's normal facing it, how that turns from place to place, and the
/// indices.
struct Bend {
    dvec3 normal{0.0};  // unit, facing: dot(normal, direction) ≤ 0
    dmat3 turning{0.0}; // 1/m, dn = turning · dx along the surface
    double n_before = 1.0, n_after = 1.0;
};

/// Covariances in units of one rounding, squared: of a length, 2⁻⁵² of the path's unit of length; of a
/// direction, 2⁻⁵² rad. What a path loses grows exponentially between curved mirrors, so a power of ten is
/// kept apart.
class Spread {
  public:
    /// At the source: one rounding of place and direction.
    ///   unit   m, > 0: the largest coordinate involved
    explicit Spread(double unit);
    Spread() = default;

    /// To the place where the path meets a surface, at which its points then lie.
    ///   facet_normal   of that surface, either way round
    void go(double t, dvec3 const& direction, dvec3 const& facet_normal);
    /// On to the direction that leaves.
    void turn(dvec3 const& direction, Bend const& bend, Event event);

    /// Decimal digits of the sixteen that place or direction have lost, whichever lost more; ≥ 0, and beyond
    /// 16 where none is left.
    double digits_lost() const;

  private:
    void keep_small();

    dmat3 place_{0.0}, mixed_{0.0}, heading_{0.0}; // mixed: place · headingᵀ
    double unit_ = 1.0, decades_ = 0.0;
};

/// Segments by the digits that they had lost where they ended: fewer than 1, fewer than 2, …, 16 or more.
struct DigitsLost {
    static constexpr std::size_t none_left = 16;
    std::array<std::uint64_t, none_left + 1> segments{};
    // the worst; of equals the earliest
    double most = -1.0;
    std::uint64_t ray = 0;
    std::uint16_t depth = 0;
    dvec3 at{0.0}; // m: where that segment began

    void count(double digits, std::uint64_t of_ray, std::uint16_t at_depth, dvec3 const& begins);
    void add(DigitsLost const& other);
};

} // namespace sahl

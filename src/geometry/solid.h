// In: a closed exact shape and a ray in the shape's own frame. Out: where the ray next crosses the shape's
// surface. A solid is the intersection of regions (half spaces, balls, …), so that its crossings alternate by
// construction, at edges and corners too: nothing is missed or met twice between two faces.
#pragma once

#include "geometry/chord.h"
#include "geometry/shape.h"
#include "math/inline_vector.h"
#include "math/vec.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sahl {

class RevolvedSheet;
struct Quadric;

/// One face's region {x: inside}. `a` is a unit normal (half space) or a centre; `b` an offset or a radius.
struct Region {
    enum class Kind : std::uint8_t {
        half_space, // a·x ≤ b
        ball,       // |x − a| ≤ b
        tube,       // x² + y² ≤ b²
        dome,       // ball ∪ {side (z − a.z) ≥ 0}: behind a convex sheet
        bowl,       // {side (z − a.z) ≥ 0} \ ball: behind a hollow sheet
        sheet,      // side (z − a.z) ≥ side · the sheet's height
        quadric,    // of x − a
        block,      // |x|, |y|, |z| ≤ a.x, a.y, a.z
    };
    Kind kind = Kind::half_space;
    dvec3 a{0.0};
    double b = 0.0;
    double side = 0.0;
    RevolvedSheet const* sheet = nullptr; // the solid keeps it
    Quadric const* quadric = nullptr;
};

/// Where a line crosses the surface. `slope` is |n·d|: the distance to the surface changes by slope per unit
/// of t.
struct SolidCrossing {
    double t = 0.0;
    double slope = 0.0;
    std::uint32_t face = 0;
    bool enters = false;
};

class Solid {
  public:
    /// The shape must be closed and without shape_problem().
    explicit Solid(Shape const& shape);
    /// What lies in all of up to six regions, which is no more than what lies between `low` and `high`.
    Solid(std::span<Region const> regions, std::vector<std::shared_ptr<Quadric const>> quadrics,
          dvec3 const& low, dvec3 const& high);

    /// The next crossing from `from` on for a ray that is inside (or not): a crossing out of (into) the
    /// solid.
    ///   direction   any length; t counts in its units
    ///   rounding    m: a crossing that lies before `from` by no more than this, measured along the normal,
    ///   is still to
    ///               come; one that lies behind it by no more than this may be the one the ray was born on
    /// Empty: it never crosses; for a ray that is inside, that contradicts the solid's being closed.
    std::optional<SolidCrossing> next(dvec3 const& origin, dvec3 const& direction, bool inside, double from,
                                      double rounding) const {
        return ball_ ? next_of_ball(origin, direction, inside, from, rounding)
                     : next_of_regions(origin, direction, inside, from, rounding);
    }

    /// Is the ray inside just after `from`? A start on the surface belongs to the side that the ray heads
    /// for.
    bool inside(dvec3 const& origin, dvec3 const& direction, double from, double rounding) const;

    /// Moves a point that is on a face but for rounding along the normal onto it; returns the outward unit
    /// normal there.
    dvec3 settle(std::uint32_t face, dvec3& point) const;

    dvec3 low() const { return low_; }
    dvec3 high() const { return high_; }
    InlineVector<Region, 6> const& regions() const { return regions_; }

  private:
    using Crossings = InlineVector<SolidCrossing, 144>; // of two sheets and a tube: revolved.h
    Crossings all(dvec3 const& origin, dvec3 const& direction, double rounding) const;

    std::optional<SolidCrossing> next_of_ball(dvec3 const& origin, dvec3 const& direction, bool inside,
                                              double from, double rounding) const;
    std::optional<SolidCrossing> next_of_regions(dvec3 const& origin, dvec3 const& direction, bool inside,
                                                 double from, double rounding) const;
    void see_what_regions_are();

    RevolvedSheet const* keep(RevolvedSheet sheet);
    Quadric const* keep(Quadric const& quadric);

    InlineVector<Region, 6> regions_; // by face number
    std::vector<std::shared_ptr<void const>> kept_;
    bool convex_ = true;
    bool ball_ = false; // and nothing else
    dvec3 low_{0.0}, high_{0.0};
};

/// A way out that is met from `from` on.
inline std::optional<SolidCrossing> leaving(SolidCrossing const& leave, double from, double rounding) {
    bool const ahead = (leave.t - from) * leave.slope >= -rounding && leave.t < INFINITY;
    return ahead ? std::optional(leave) : std::nullopt;
}

inline std::optional<SolidCrossing> Solid::next_of_ball(dvec3 const& origin, dvec3 const& direction,
                                                        bool inside, double from, double rounding) const {
    Region const& ball = regions_.front();
    dvec3 const to_origin = origin - ball.a;
    // from outside, or the surface, it goes away: no root need be drawn to see that
    if (!inside && from >= 0.0 && dot(to_origin, direction) > 0.0 &&
        dot(to_origin, to_origin) - ball.b * ball.b >= -2.0 * rounding * ball.b)
        return std::nullopt;
    Chord const chord = round_chord(to_origin, direction, dot(direction, direction), ball.b, rounding);
    if (inside)
        return leaving({chord.leave, chord.slope, 0, false}, from, rounding);
    bool const ahead =
        (chord.enter - from) * chord.slope >= -rounding && (chord.leave - from) * chord.slope > rounding;
    return !chord.missed && chord.enter < chord.leave && ahead
               ? std::optional(SolidCrossing{chord.enter, chord.slope, 0, true})
               : std::nullopt;
}

} // namespace sahl

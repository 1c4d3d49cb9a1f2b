// In: a surface of revolution (a conic with even aspheric terms, vertex at the origin, axis z) and a line.
// Out: every place where the line crosses it, in order, and the normal there.
#pragma once

#include "geometry/shape.h"
#include "math/inline_vector.h"
#include "math/vec.h"

#include <utility>
#include <vector>

namespace sahl {

/// So many even aspheric terms at most: with K of them a line meets the implicit form, a polynomial of degree
/// 4 (K + 1), as often, twice more its continuation beyond the equator, and twice the plane beyond the rim.
inline constexpr std::size_t most_aspheric_terms = 15;
inline constexpr std::size_t most_sheet_crossings = 4 * (most_aspheric_terms + 1) + 4;

/// z = c r²/(1 + √(1 − (1 + k) c² r²)) + Σ terms[i] r^(4 + 2i), lengths in m.
struct Revolved {
    double curvature = 0.0, conic = 0.0;
    std::vector<double> terms;

    /// Up to which r the surface goes; ∞: to any.
    double reach() const;
    double sag(double r) const; // r ≤ reach(); rounding beyond it is taken as it
};

Revolved front_of(Lens const& lens); // each from its own vertex
Revolved back_of(Lens const& lens);
Revolved form_of(ConicMirror const& mirror);

/// The surface up to r = aperture. Extended, it goes on beyond as the plane through its rim.
class RevolvedSheet {
  public:
    RevolvedSheet(Revolved form, double aperture, double hole = 0.0);

    struct Root {
        double t = 0.0;
        double slope = 0.0; // |n·d|
        bool rises = false; // from below to above (+z)
    };
    using Roots = InlineVector<Root, most_sheet_crossings>;

    /// All crossings, alternately up and down where the surface is extended. Between two bounds of the
    /// height's slope along the line (interval arithmetic) each root is bracketed before Newton's method is
    /// let loose, so that none is missed, however near the rim.
    ///   rounding   m: an origin within this of the surface is on it, and the line crosses it exactly there
    Roots roots(dvec3 const& origin, dvec3 const& direction, double rounding, bool extended) const;

    /// Does the line come from above? Of the extended surface, far back.
    bool from_above(dvec3 const& origin, dvec3 const& direction) const;

    /// From the surface to the point to first order, > 0 above; and the unit normal towards +z.
    double distance(dvec3 const& point) const;
    bool is_near(dvec3 const& point, double rounding) const; // |distance| ≤ rounding
    dvec3 normal(dvec3 const& point) const;
    /// Moves a point that is on the surface but for rounding along the normal onto it; returns the normal.
    dvec3 settle(dvec3& point) const;

    /// Is r within the aperture and not in the hole? Both borders belong to the surface.
    bool covers(dvec3 const& point) const;

    Revolved const& form() const { return form_; }
    double aperture() const { return aperture_; }
    double rim() const { return rim_; } // m: height there
    /// Lowest and highest z, or a little beyond.
    std::pair<double, double> heights() const { return {low_, high_}; }

  private:
    class Line;
    struct Height;
    Height height(dvec3 const& point) const;

    Revolved form_;
    double aperture_, hole_, rim_;
    double low_ = 0.0, high_ = 0.0;
};

} // namespace sahl

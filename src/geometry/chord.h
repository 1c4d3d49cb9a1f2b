// In: a line and a ball or a tube. Out: the stretch of the line that lies in it.
#pragma once

#include "math/vec.h"

#include <cmath>

namespace sahl {

/// A stretch of a line inside a region; ±∞ where it has no end.
struct Chord {
    double enter = -INFINITY, leave = INFINITY;
    double slope = 1.0;        // |n·d| where it enters and leaves
    bool missed = false;       // the line does not meet the region; enter = leave is where it comes nearest
    double leave_slope = -1.0; // where it leaves; < 0: as `slope`
};

/// Both ends of the line's way through |P(x) − a| ≤ b, P the projection that `origin` and `direction` already
/// had.
///   squared    |direction|² after projection
///   rounding   m: an origin that is no farther than this from the border is on it, so that a chord of any
///              grazing angle has its length
/// From far off the discriminant is formed from the point nearest to the centre, which keeps its digits
/// (E. Haines et al., Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems, 2019); from
/// nearby the usual form does, and that alone at grazing angles.
template <class Vector>
Chord round_chord(Vector const& to_origin, Vector const& direction, double squared, double radius,
                  double rounding) {
    double const half = dot(to_origin, direction);
    double constant = dot(to_origin, to_origin) - radius * radius;
    if (std::abs(constant) <= 2.0 * rounding * radius)
        constant = 0.0;
    double discriminant = half * half - squared * constant; // squared times that of the nearest point
    if (constant > radius * radius) {
        Vector const nearest = to_origin - (half / squared) * direction;
        discriminant = squared * (radius * radius - dot(nearest, nearest));
    }
    if (discriminant < 0.0)
        return {-half / squared, -half / squared, 0.0, true};
    double const root = std::sqrt(discriminant);
    double const q = half > 0.0 ? -half - root : root - half; // no cancellation
    double const one = q / squared, other = q == 0.0 ? 0.0 : constant / q;
    return half > 0.0 ? Chord{one, other, root / radius, false} : Chord{other, one, root / radius, false};
}

} // namespace sahl

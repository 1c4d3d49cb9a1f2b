// In: a region and a line. Out: the stretches of the line that lie in it, and the normal of its border.
#pragma once

#include "geometry/solid.h"

#include <cmath>

namespace sahl {

/// A stretch of a line inside a region; ±∞ where it has no end.
struct Chord {
    double enter = -INFINITY, leave = INFINITY;
    double slope = 1.0;  // |n·d| where it enters and leaves
    bool missed = false; // the line does not meet the region; enter = leave is where it comes nearest
};

using Chords = InlineVector<Chord, 2>;

/// Both ends of the line's way through |P(x) − a| ≤ b, P the projection that `origin` and `direction` already had.
///   squared   |direction|² after projection
/// The discriminant is formed from the point nearest to the centre, which keeps its digits for far origins
/// (E. Haines et al., Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems, 2019).
template <class Vector>
Chord round_chord(Vector const& to_origin, Vector const& direction, double squared, double radius) {
    double const half = dot(to_origin, direction);
    Vector const nearest = to_origin - (half / squared) * direction;
    double const discriminant = radius * radius - dot(nearest, nearest);
    if (discriminant < 0.0)
        return {-half / squared, -half / squared, 0.0, true};
    double const root = std::sqrt(squared * discriminant);
    double const distance = std::sqrt(dot(to_origin, to_origin));
    double const constant = (distance - radius) * (distance + radius);
    double const q = half > 0.0 ? -half - root : root - half; // no cancellation
    double const one = q / squared, other = q == 0.0 ? 0.0 : constant / q;
    return half > 0.0 ? Chord{one, other, root / radius, false} : Chord{other, one, root / radius, false};
}

/// The chord of a convex region: half space, ball or tube.
inline Chord chord_of(Region const& region, dvec3 const& origin, dvec3 const& direction) {
    switch (region.kind) {
    case Region::Kind::half_space: {
        double const along = dot(region.a, direction);
        double const depth = region.b - dot(region.a, origin);
        if (along > 0.0)
            return {-INFINITY, depth / along, along, false};
        if (along < 0.0)
            return {depth / along, INFINITY, -along, false};
        return depth >= 0.0 ? Chord{} : Chord{-INFINITY, INFINITY, 1.0, true};
    }
    case Region::Kind::tube: {
        dvec2 const across(direction.x, direction.y), start(origin.x, origin.y);
        double const squared = dot(across, across);
        if (squared == 0.0)
            return dot(start, start) <= region.b * region.b ? Chord{} : Chord{-INFINITY, INFINITY, 1.0, true};
        return round_chord(start, across, squared, region.b);
    }
    default:
        return round_chord(origin - region.a, direction, dot(direction, direction), region.b);
    }
}

/// All chords of any region, in order.
inline Chords chords_of(Region const& region, dvec3 const& origin, dvec3 const& direction) {
    Chords chords;
    Chord const first = chord_of(region, origin, direction);
    bool const dome = region.kind == Region::Kind::dome;
    if (!dome && region.kind != Region::Kind::bowl) {
        if (!first.missed)
            chords.push_back(first);
        return chords;
    }
    // the half space side (z − a.z) ≥ 0, and the ball cut out of it or joined to it
    Region const flat{Region::Kind::half_space, {0.0, 0.0, -region.side}, -region.side * region.a.z, 0.0};
    Chord const half = chord_of(flat, origin, direction);
    if (first.missed || half.missed) {
        if (!half.missed)
            chords.push_back(half);
        if (dome && !first.missed)
            chords.push_back(first);
        return chords;
    }
    if (dome) {
        if (half.leave < first.enter || first.leave < half.enter) {
            bool const half_first = half.leave < first.enter;
            chords.push_back(half_first ? half : first);
            chords.push_back(half_first ? first : half);
        } else {
            chords.push_back({std::min(half.enter, first.enter), std::max(half.leave, first.leave), first.slope, false});
        }
        return chords;
    }
    Chord const before{half.enter, std::min(half.leave, first.enter), first.slope, false};
    Chord const after{std::max(half.enter, first.leave), half.leave, first.slope, false};
    for (Chord const& chord : {before, after})
        if (chord.enter < chord.leave)
            chords.push_back(chord);
    return chords;
}

inline dvec3 normal_of(Region const& region, dvec3 const& point) {
    switch (region.kind) {
    case Region::Kind::half_space:
        return region.a;
    case Region::Kind::tube:
        return normalize(dvec3(point.x, point.y, 0.0));
    case Region::Kind::bowl:
        return normalize(region.a - point);
    default:
        return normalize(point - region.a);
    }
}

inline dvec3 moved_onto(Region const& region, dvec3 const& point) {
    switch (region.kind) {
    case Region::Kind::half_space:
        return point - (dot(region.a, point) - region.b) * region.a;
    case Region::Kind::tube: {
        double const scale = region.b / std::sqrt(point.x * point.x + point.y * point.y);
        return {point.x * scale, point.y * scale, point.z};
    }
    default: {
        dvec3 const from_centre = point - region.a;
        return region.a + (region.b / length(from_centre)) * from_centre;
    }
    }
}

} // namespace sahl

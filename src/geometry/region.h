// In: a region and a line. Out: the stretches of the line that lie in it, and the normal of its border.
#pragma once

#include "geometry/chord.h"
#include "geometry/quadric.h"
#include "geometry/revolved.h"
#include "geometry/solid.h"

#include <cmath>

namespace sahl {

using Chords = InlineVector<Chord, most_sheet_crossings / 2 + 1>;

/// The chord of a convex region: half space, ball or tube.
inline Chord chord_of(Region const& region, dvec3 const& origin, dvec3 const& direction, double rounding) {
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
        return round_chord(start, across, squared, region.b, rounding);
    }
    default:
        return round_chord(origin - region.a, direction, dot(direction, direction), region.b, rounding);
    }
}

/// The half space side (z − a.z) ≥ 0 of a dome or a bowl.
inline Region flat_of(Region const& region) {
    return {Region::Kind::half_space, {0.0, 0.0, -region.side}, -region.side * region.a.z, 0.0};
}

inline Chord block_chord(dvec3 const& half, dvec3 const& origin, dvec3 const& direction) {
    Chord chord;
    chord.leave_slope = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        double const d = direction[axis], o = origin[axis], slope = std::abs(d);
        if (d == 0.0) {
            chord.missed = chord.missed || std::abs(o) > half[axis];
            continue;
        }
        double const enter = (std::copysign(half[axis], -d) - o) / d,
                     leave = (std::copysign(half[axis], d) - o) / d;
        if (enter > chord.enter) {
            chord.enter = enter;
            chord.slope = slope;
        }
        if (leave < chord.leave) {
            chord.leave = leave;
            chord.leave_slope = slope;
        }
    }
    chord.missed = chord.missed || chord.enter >= chord.leave;
    return chord;
}

inline Chords quadric_chords(Region const& region, dvec3 const& origin, dvec3 const& direction,
                             double rounding) {
    dvec3 const from = origin - region.a;
    QuadricRoots const roots = roots_of(*region.quadric, from, direction, rounding);
    auto const slope = [&](double t) {
        return std::isfinite(t) ? slope_at(*region.quadric, from + t * direction, direction) : 1.0;
    };
    Chords chords;
    if (!roots.any) {
        if (roots.everywhere)
            chords.push_back(Chord{});
    } else if (roots.between) {
        chords.push_back({roots.one, roots.two, slope(roots.one), false, slope(roots.two)});
    } else {
        chords.push_back({-INFINITY, roots.one, 1.0, false, slope(roots.one)});
        chords.push_back({roots.two, INFINITY, slope(roots.two), false, 1.0});
    }
    return chords;
}

inline Chords sheet_chords(Region const& region, dvec3 const& origin, dvec3 const& direction,
                           double rounding) {
    dvec3 const from = origin - region.a;
    bool const upper = region.side > 0.0;
    Chords chords;
    Chord chord;
    bool in = region.sheet->from_above(from, direction) == upper;
    for (RevolvedSheet::Root const& root : region.sheet->roots(from, direction, rounding, true)) {
        if ((root.rises == upper) == in) // it is on that side already
            continue;
        if (in) {
            chord.leave = root.t;
            chord.leave_slope = root.slope;
            chords.push_back(chord);
        }
        in = !in;
        chord = Chord{root.t, INFINITY, root.slope, false, 1.0};
    }
    if (in)
        chords.push_back(chord);
    return chords;
}

/// Of the chords of a region that the line is in at `from`, that which it is in; in a gap, where rounding put
/// it, the nearer one.
inline Chord way_out(Chords const& chords, double from) {
    for (std::size_t i = 0; i < chords.size(); ++i) {
        bool const last = i + 1 == chords.size();
        if (last || from < 0.5 * (chords[i].leave + chords[i + 1].enter)) {
            Chord chord = chords[i];
            chord.slope = chord.leave_slope < 0.0 ? chord.slope : chord.leave_slope;
            return chord;
        }
    }
    return {from, from, 0.0, true}; // it is no deeper than rounding
}

inline bool has_own_chords(Region const& region) {
    return region.kind == Region::Kind::sheet || region.kind == Region::Kind::quadric ||
           region.kind == Region::Kind::block;
}

inline Chords own_chords(Region const& region, dvec3 const& origin, dvec3 const& direction, double rounding) {
    if (region.kind == Region::Kind::sheet)
        return sheet_chords(region, origin, direction, rounding);
    if (region.kind == Region::Kind::quadric)
        return quadric_chords(region, origin, direction, rounding);
    Chords chords;
    Chord const chord = block_chord(region.a, origin, direction);
    if (!chord.missed)
        chords.push_back(chord);
    return chords;
}

/// The chord that ends where a line leaves a region that it is in at `from`. Nothing is asked about the way
/// in: at an edge rounding may put it behind the way out.
inline Chord way_out(Region const& region, dvec3 const& origin, dvec3 const& direction, double from,
                     double rounding) {
    if (region.kind == Region::Kind::block) {
        Chord chord = block_chord(region.a, origin, direction);
        chord.slope = chord.leave_slope;
        return chord;
    }
    if (has_own_chords(region))
        return way_out(own_chords(region, origin, direction, rounding), from);
    Chord const round = chord_of(region, origin, direction, rounding);
    bool const dome = region.kind == Region::Kind::dome;
    if (!dome && region.kind != Region::Kind::bowl)
        return round;
    Chord const half = chord_of(flat_of(region), origin, direction, rounding);
    if (round.missed)
        return half;
    if (dome) // by the ball's near half; on the far one it goes over into the half space
        return region.side * (origin.z + round.leave * direction.z - region.a.z) <= 0.0 ? round : Chord{};
    bool const ahead = (round.leave - from) * round.slope > rounding;
    return ahead && round.enter < half.leave ? Chord{half.enter, round.enter, round.slope, false} : half;
}

/// All chords of any region, in order.
inline Chords chords_of(Region const& region, dvec3 const& origin, dvec3 const& direction, double rounding) {
    if (has_own_chords(region))
        return own_chords(region, origin, direction, rounding);
    Chords chords;
    Chord const first = chord_of(region, origin, direction, rounding);
    bool const dome = region.kind == Region::Kind::dome;
    if (!dome && region.kind != Region::Kind::bowl) {
        if (!first.missed)
            chords.push_back(first);
        return chords;
    }
    // the half space, and the ball cut out of it or joined to it
    Chord const half = chord_of(flat_of(region), origin, direction, rounding);
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
            chords.push_back(
                {std::min(half.enter, first.enter), std::max(half.leave, first.leave), first.slope, false});
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

inline dvec3 settle_on_block(dvec3 const& half, dvec3& point) {
    int nearest = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (std::abs(std::abs(point[axis]) - half[axis]) < std::abs(std::abs(point[nearest]) - half[nearest]))
            nearest = axis;
    dvec3 normal(0.0);
    normal[nearest] = std::copysign(1.0, point[nearest]);
    point[nearest] = std::copysign(half[nearest], point[nearest]);
    return normal;
}

/// Moves the point along the normal onto the region's border; returns the outward unit normal there.
inline dvec3 settle(Region const& region, dvec3& point) {
    switch (region.kind) {
    case Region::Kind::half_space:
        point -= (dot(region.a, point) - region.b) * region.a;
        return region.a;
    case Region::Kind::tube: {
        double const by_distance = 1.0 / std::sqrt(point.x * point.x + point.y * point.y);
        dvec3 const normal(point.x * by_distance, point.y * by_distance, 0.0);
        point = {region.b * normal.x, region.b * normal.y, point.z};
        return normal;
    }
    case Region::Kind::sheet: {
        dvec3 local = point - region.a;
        dvec3 const normal = region.sheet->settle(local);
        point = region.a + local;
        return -region.side * normal;
    }
    case Region::Kind::quadric: {
        dvec3 const before = point - region.a;
        dvec3 local = before;
        dvec3 const normal = settle(*region.quadric, local);
        point += local - before; // a cone's apex may be so far off that the way back would lose digits
        return normal;
    }
    case Region::Kind::block:
        return settle_on_block(region.a, point);
    default: {
        dvec3 const normal = unit_again((1.0 / region.b) * (point - region.a));
        point = region.a + region.b * normal;
        return region.kind == Region::Kind::bowl ? -normal : normal;
    }
    }
}

} // namespace sahl

#include "geometry/solid.h"

#include "geometry/quadric.h"
#include "geometry/region.h"
#include "geometry/revolved.h"
#include "math/overloaded.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

using Kind = Region::Kind;

Region half_space(dvec3 normal, double offset) {
    return {Kind::half_space, normal, offset, 0.0};
}

/// The region behind a lens's surface with its vertex at z = vertex; side +1: the glass is at larger z.
Region sheet(double vertex, double radius, double side, double opposite_vertex) {
    if (radius == 0.0)
        return half_space({0.0, 0.0, -side}, -side * vertex);
    double const centre = vertex + radius;
    if (radius * side < 0.0)
        return {Kind::bowl, {0.0, 0.0, centre}, std::abs(radius), side};
    // the ball alone will do where all of the lens lies on the near side of its centre
    bool const ball_is_enough = side * (centre - opposite_vertex) >= 0.0;
    return {ball_is_enough ? Kind::ball : Kind::dome, {0.0, 0.0, centre}, std::abs(radius), side};
}

Region with(Quadric const* quadric, dvec3 const& origin) {
    Region region{Kind::quadric, origin, 0.0, 0.0};
    region.quadric = quadric;
    return region;
}

/// Of which each line has one chord at the most.
bool all_convex(InlineVector<Region, 6> const& regions) {
    return std::none_of(regions.begin(), regions.end(), [](Region const& r) {
        return r.kind == Kind::dome || r.kind == Kind::bowl || has_own_chords(r);
    });
}

} // namespace

Solid::Solid(Shape const& shape) {
    static_assert(sizeof(Crossings) >= 2 * (most_sheet_crossings + 2) * sizeof(SolidCrossing));
    auto const add = [this](Region const& region) { regions_.push_back(region); };
    std::visit(
        Overloaded{
            [&](Sphere const& s) {
                add({Kind::ball, dvec3(0.0), s.radius, 0.0});
                high_ = dvec3(s.radius);
                low_ = -high_;
            },
            [&](Box const& s) {
                high_ = 0.5 * s.size;
                low_ = -high_;
                for (int axis = 0; axis < 3; ++axis)
                    for (double sign : {-1.0, 1.0}) {
                        dvec3 normal(0.0);
                        normal[axis] = sign;
                        add(half_space(normal, high_[axis]));
                    }
            },
            [&](Cylinder const& s) {
                high_ = {s.radius, s.radius, 0.5 * s.length};
                low_ = -high_;
                add({Kind::tube, dvec3(0.0), s.radius, 0.0});
                add(half_space({0.0, 0.0, -1.0}, high_.z));
                add(half_space({0.0, 0.0, 1.0}, high_.z));
            },
            [&](Cone const& s) {
                double const h = std::max(s.radius, s.top_radius);
                high_ = {h, h, 0.5 * s.length};
                low_ = -high_;
                double const widening = (s.top_radius - s.radius) / s.length;
                double const apex = -0.5 * (s.top_radius + s.radius) / widening;
                if (widening == 0.0)
                    add({Kind::tube, dvec3(0.0), s.radius, 0.0});
                else // lines are met from near the apex where it is part of the body, and has all digits
                    add(with(keep(cone_quadric(widening, s.radius > 0.0 && s.top_radius > 0.0 ? -apex : 0.0)),
                             {0.0, 0.0, apex}));
                add(half_space({0.0, 0.0, -1.0}, high_.z));
                add(half_space({0.0, 0.0, 1.0}, high_.z));
            },
            [&](CornerCube const& s) {
                high_ = dvec3(s.side);
                for (int axis = 0; axis < 3; ++axis) {
                    dvec3 normal(0.0);
                    normal[axis] = -1.0;
                    add(half_space(normal, 0.0));
                }
                double const third = 1.0 / std::sqrt(3.0);
                add(half_space(dvec3(third), third * s.side));
            },
            [&](QuadricBody const& s) {
                high_ = 0.5 * s.clip;
                low_ = -high_;
                add(with(keep(quadric_of(s)), dvec3(0.0)));
                add({Kind::block, high_, 0.0, 0.0});
            },
            [&](Lens const& s) {
                double const h = 0.5 * s.diameter;
                RevolvedSheet const front(front_of(s), h), back(back_of(s), h);
                low_ = {-h, -h, front.heights().first};
                high_ = {h, h, s.thickness + back.heights().second};
                auto const add_sheet = [&](RevolvedSheet const& surface, double vertex, double radius,
                                           double side, double opposite) {
                    bool const sphere = surface.form().conic == 0.0 || radius == 0.0;
                    add(sphere && surface.form().terms.empty()
                            ? sheet(vertex, radius, side, opposite)
                            : Region{Kind::sheet, {0.0, 0.0, vertex}, 0.0, side, keep(surface)});
                };
                add_sheet(front, 0.0, s.r1, 1.0, high_.z);
                add_sheet(back, s.thickness, s.r2, -1.0, low_.z);
                add({Kind::tube, dvec3(0.0), h, 0.0});
            },
            [&](Prism const& s) {
                double const half = 0.5 * s.apex;
                double const c = std::cos(half), i = std::sin(half);
                high_ = {s.side * i, 0.5 * s.side * c, 0.5 * s.length};
                low_ = -high_;
                double const apex = i * high_.y; // both inclined faces hold the apex edge (0, high.y)
                add(half_space({-c, i, 0.0}, apex));
                add(half_space({c, i, 0.0}, apex));
                add(half_space({0.0, -1.0, 0.0}, high_.y));
                add(half_space({0.0, 0.0, -1.0}, high_.z));
                add(half_space({0.0, 0.0, 1.0}, high_.z));
            },
            [](auto const&) { assert(false && "an open shape is not a solid"); },
        },
        shape);
    see_what_regions_are();
}

Solid::Solid(std::span<Region const> regions, std::vector<std::shared_ptr<Quadric const>> quadrics,
             dvec3 const& low, dvec3 const& high)
    : kept_(quadrics.begin(), quadrics.end()), low_(low), high_(high) {
    for (Region const& region : regions)
        regions_.push_back(region);
    see_what_regions_are();
}

void Solid::see_what_regions_are() {
    convex_ = all_convex(regions_);
    ball_ = regions_.size() == 1 && regions_.front().kind == Kind::ball;
}

RevolvedSheet const* Solid::keep(RevolvedSheet sheet) {
    auto const kept = std::make_shared<RevolvedSheet const>(std::move(sheet));
    kept_.push_back(kept);
    return kept.get();
}

Quadric const* Solid::keep(Quadric const& quadric) {
    auto const kept = std::make_shared<Quadric const>(quadric);
    kept_.push_back(kept);
    return kept.get();
}

std::optional<SolidCrossing> Solid::next_of_regions(dvec3 const& origin, dvec3 const& direction, bool inside,
                                                    double from, double rounding) const {
    if (!convex_ && inside) {
        SolidCrossing leave{INFINITY, 1.0, 0, false};
        for (std::uint32_t face = 0; face < regions_.size(); ++face) {
            Chord const chord = way_out(regions_[face], origin, direction, from, rounding);
            if (chord.leave < leave.t)
                leave = {chord.leave, chord.slope, face, false};
        }
        return leaving(leave, from, rounding);
    }
    if (!convex_) {
        // an entry within the rounding counts where the line runs inside behind it, since crossings alternate
        SolidCrossing const* at_start = nullptr;
        Crossings const crossings = all(origin, direction, rounding);
        for (SolidCrossing const& c : crossings) {
            double const distance = (c.t - from) * c.slope;
            if (distance > rounding)
                return c.enters ? std::optional(c) : at_start ? std::optional(*at_start) : std::nullopt;
            if (distance >= -rounding && c.enters)
                at_start = &c;
        }
        return std::nullopt;
    }
    SolidCrossing enter{-INFINITY, 1.0, 0, true}, leave{INFINITY, 1.0, 0, false};
    for (std::uint32_t face = 0; face < regions_.size(); ++face) {
        Chord const chord = chord_of(regions_[face], origin, direction, rounding);
        if (chord.missed && !inside)
            return std::nullopt;
        if (chord.enter > enter.t)
            enter = {chord.enter, chord.slope, face, true};
        if (chord.leave < leave.t)
            leave = {chord.leave, chord.slope, face, false};
    }
    if (inside) // only the way out counts: at an edge rounding may put the way in behind it
        return leaving(leave, from, rounding);
    bool const ahead =
        (enter.t - from) * enter.slope >= -rounding && (leave.t - from) * leave.slope > rounding;
    return enter.t < leave.t && ahead && enter.t > -INFINITY ? std::optional(enter) : std::nullopt;
}

bool Solid::inside(dvec3 const& origin, dvec3 const& direction, double from, double rounding) const {
    for (SolidCrossing const& c : all(origin, direction, rounding))
        if ((c.t - from) * c.slope > rounding)
            return !c.enters;
    return false;
}

Solid::Crossings Solid::all(dvec3 const& origin, dvec3 const& direction, double rounding) const {
    // a sweep over all regions' borders: inside the solid is inside every region
    Crossings borders;
    auto const earlier = [](SolidCrossing const& a, SolidCrossing const& b) {
        return a.t != b.t ? a.t < b.t : a.enters < b.enters;
    };
    std::size_t depth = 0;
    for (std::uint32_t face = 0; face < regions_.size(); ++face) {
        Chords const chords = chords_of(regions_[face], origin, direction, rounding);
        for (Chord const& chord : chords) {
            if (chord.enter == -INFINITY)
                ++depth;
            else
                borders.insert_sorted({chord.enter, chord.slope, face, true}, earlier);
            if (chord.leave < INFINITY)
                borders.insert_sorted(
                    {chord.leave, chord.leave_slope < 0.0 ? chord.slope : chord.leave_slope, face, false},
                    earlier);
        }
    }
    Crossings crossings;
    for (SolidCrossing const& border : borders) {
        if (border.enters) {
            if (++depth == regions_.size())
                crossings.push_back(border);
        } else if (depth-- == regions_.size()) {
            crossings.push_back(border);
        }
    }
    return crossings;
}

dvec3 Solid::settle(std::uint32_t face, dvec3& point) const {
    return sahl::settle(regions_[face], point);
}

} // namespace sahl

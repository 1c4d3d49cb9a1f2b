// In: a closed exact shape and a line in its frame. Out: every place where the line crosses its surface, from
// the shape's definition in words: a point is inside or it is not, and that may change only where a line
// meets one of the surfaces. Slow, wide, and with nothing in common with src/.
#pragma once

#include "geometry/shape.h"
#include "math/overloaded.h"
#include "torture/wide.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace sahl::bench {

template <class T>
struct LocalCrossing {
    T t;
    std::uint32_t face;
    int turn;        // +1 into the shape
    Wide3<T> normal; // outward
};

template <class T>
class ExactShape {
  public:
    explicit ExactShape(Shape const& shape);
    void cross_with(Wide3<T> const& origin, Wide3<T> const& direction,
                    std::vector<LocalCrossing<T>>& out) const;
    Wide3<T> onto(std::uint32_t face, Wide3<T> const& point) const;

  private:
    enum class Kind { plane, ball, tube, quadric };
    struct Border {
        Kind kind;
        Wide3<T> a; // unit normal but for the rounding of its doubles, or centre
        T b;        // offset or radius
        int outward = 1;
        std::array<T, 10> q{}; // of xx, yy, zz, xy, xz, yz, x, y, z, 1; inside it is negative
    };
    T value(Border const& border, Wide3<T> const& p) const;
    Wide3<T> gradient(Border const& border, Wide3<T> const& p) const;
    /// What a border bounds: side 0, {a·x < b} or the ball or the tube; ±1, a lens's sheet: the part of the
    /// glass towards ±z, in front of a ball (hollow) or with it (round).
    bool within(std::size_t face, Wide3<T> const& p) const;
    Wide3<T> normal_at(std::size_t face, Wide3<T> const& p) const;
    void sheet(T vertex, double radius, int side);

    std::vector<Border> borders_;
    std::vector<int> sides_;
    std::uint32_t first_cap_ = 0xFFFFFFFFu; // from this border on all are one face
};

template <class T>
T ExactShape<T>::value(Border const& border, Wide3<T> const& p) const {
    auto const& q = border.q;
    return q[0] * p.x * p.x + q[1] * p.y * p.y + q[2] * p.z * p.z + q[3] * p.x * p.y + q[4] * p.x * p.z +
           q[5] * p.y * p.z + q[6] * p.x + q[7] * p.y + q[8] * p.z + q[9];
}

template <class T>
Wide3<T> ExactShape<T>::gradient(Border const& border, Wide3<T> const& p) const {
    auto const& q = border.q;
    return {2 * q[0] * p.x + q[3] * p.y + q[4] * p.z + q[6], 2 * q[1] * p.y + q[3] * p.x + q[5] * p.z + q[7],
            2 * q[2] * p.z + q[4] * p.x + q[5] * p.y + q[8]};
}

template <class T>
void ExactShape<T>::sheet(T vertex, double radius, int side) {
    if (radius == 0.0) {
        borders_.push_back({Kind::plane, {0, 0, T(-side)}, -side * vertex});
        sides_.push_back(0);
        return;
    }
    bool const hollow = radius * side < 0.0;
    borders_.push_back({Kind::ball, {0, 0, vertex + T(radius)}, absolute_of(T(radius)), hollow ? -1 : 1});
    sides_.push_back(side);
}

template <class T>
ExactShape<T>::ExactShape(Shape const& shape) {
    auto const plane = [&](dvec3 const& normal, T offset) {
        borders_.push_back({Kind::plane, Wide3<T>(normal), offset});
    };
    std::visit(Overloaded{
                   [&](Sphere const& s) {
                       borders_.push_back({Kind::ball, {}, T(s.radius)});
                   },
                   [&](Box const& s) {
                       for (int axis = 0; axis < 3; ++axis)
                           for (double sign : {-1.0, 1.0}) {
                               dvec3 normal(0.0);
                               normal[axis] = sign;
                               plane(normal, T(s.size[axis]) / 2);
                           }
                   },
                   [&](Cylinder const& s) {
                       borders_.push_back({Kind::tube, {}, T(s.radius)});
                       plane({0.0, 0.0, -1.0}, T(s.length) / 2);
                       plane({0.0, 0.0, 1.0}, T(s.length) / 2);
                   },
                   [&](Lens const& s) {
                       sheet(0, s.r1, 1);
                       sheet(T(s.thickness), s.r2, -1);
                       borders_.push_back({Kind::tube, {}, T(s.diameter) / 2});
                       sides_.push_back(0);
                   },
                   [&](Prism const& s) {
                       double const c = std::cos(0.5 * s.apex), i = std::sin(0.5 * s.apex);
                       T const top = T(s.side) * T(c) / 2;
                       plane({-c, i, 0.0}, T(i) * top);
                       plane({c, i, 0.0}, T(i) * top);
                       plane({0.0, -1.0, 0.0}, top);
                       plane({0.0, 0.0, -1.0}, T(s.length) / 2);
                       plane({0.0, 0.0, 1.0}, T(s.length) / 2);
                   },
                   [&](Cone const& s) {
                       T const slope = (T(s.top_radius) - T(s.radius)) / T(s.length),
                               middle = (T(s.radius) + T(s.top_radius)) / 2;
                       Border side{Kind::quadric, {}, 0};
                       side.q = {1, 1, -slope * slope, 0, 0, 0, 0, 0, -2 * slope * middle, -middle * middle};
                       borders_.push_back(side);
                       plane({0.0, 0.0, -1.0}, T(s.length) / 2);
                       plane({0.0, 0.0, 1.0}, T(s.length) / 2);
                   },
                   [&](CornerCube const& s) {
                       for (int axis = 0; axis < 3; ++axis) {
                           dvec3 normal(0.0);
                           normal[axis] = -1.0;
                           plane(normal, 0);
                       }
                       plane(dvec3(1.0), T(s.side));
                   },
                   [&](QuadricBody const& s) {
                       Border surface{Kind::quadric, {}, 0};
                       for (std::size_t k = 0; k < 10; ++k)
                           surface.q[k] = T(s.coefficients[k]);
                       borders_.push_back(surface);
                       first_cap_ = 1;
                       for (int axis = 0; axis < 3; ++axis)
                           for (double sign : {-1.0, 1.0}) {
                               dvec3 normal(0.0);
                               normal[axis] = sign;
                               plane(normal, T(s.clip[axis]) / 2);
                           }
                   },
                   [](auto const&) {},
               },
               shape);
    sides_.resize(borders_.size(), 0);
}

template <class T>
bool ExactShape<T>::within(std::size_t face, Wide3<T> const& p) const {
    Border const& border = borders_[face];
    if (border.kind == Kind::plane)
        return dot(border.a, p) < border.b;
    if (border.kind == Kind::quadric)
        return value(border, p) < 0;
    Wide3<T> from = p - border.a;
    if (border.kind == Kind::tube)
        from.z = 0;
    bool const in_round = dot(from, from) < border.b * border.b;
    if (sides_[face] == 0)
        return in_round;
    bool const beyond = sides_[face] * from.z > 0;
    return border.outward > 0 ? in_round || beyond : beyond && !in_round;
}

template <class T>
Wide3<T> ExactShape<T>::normal_at(std::size_t face, Wide3<T> const& p) const {
    Border const& border = borders_[face];
    if (border.kind == Kind::plane)
        return border.a;
    if (border.kind == Kind::quadric)
        return normalize(gradient(border, p));
    Wide3<T> from = p - border.a;
    if (border.kind == Kind::tube)
        from.z = 0;
    return T(border.outward) * normalize(from);
}

template <class T>
Wide3<T> ExactShape<T>::onto(std::uint32_t face, Wide3<T> const& point) const {
    auto const off = [&](Border const& cap) { return absolute_of(dot(cap.a, point) - cap.b); };
    if (face >= first_cap_) // the nearest of them
        for (std::uint32_t cap = first_cap_; cap < borders_.size(); ++cap)
            if (off(borders_[cap]) < off(borders_[face]))
                face = cap;
    Border const& border = borders_[face];
    if (border.kind == Kind::quadric) {
        Wide3<T> on = point;
        for (int step = 0; step < 8; ++step) { // Newton's, from as near as rounding
            Wide3<T> const up = gradient(border, on);
            on = on - (value(border, on) / dot(up, up)) * up;
        }
        return on;
    }
    if (border.kind == Kind::plane)
        return point - ((dot(border.a, point) - border.b) / dot(border.a, border.a)) * border.a;
    Wide3<T> from = point - border.a;
    T const z = from.z;
    if (border.kind == Kind::tube)
        from.z = 0;
    Wide3<T> on = border.a + (border.b / length(from)) * from;
    if (border.kind == Kind::tube)
        on.z = border.a.z + z;
    return on;
}

template <class T>
void ExactShape<T>::cross_with(Wide3<T> const& origin, Wide3<T> const& direction,
                               std::vector<LocalCrossing<T>>& out) const {
    struct Meeting {
        T t;
        std::uint32_t face;
    };
    Meeting met[16];
    std::size_t count = 0;
    for (std::uint32_t face = 0; face < borders_.size(); ++face) {
        Border const& border = borders_[face];
        if (border.kind == Kind::plane) {
            if (T const along = dot(border.a, direction); along != 0)
                met[count++] = {(border.b - dot(border.a, origin)) / along, face};
            continue;
        }
        if (border.kind == Kind::quadric) {
            T const half = dot(gradient(border, origin), direction) / 2, c = value(border, origin);
            T const a =
                (value(border, direction) - dot(gradient(border, Wide3<T>()), direction)) - border.q[9];
            T const under = half * half - a * c;
            if (under <= 0)
                continue;
            T const sum = -(half + (half < 0 ? -root_of(under) : root_of(under)));
            if (a != 0)
                met[count++] = {sum / a, face};
            if (sum != 0)
                met[count++] = {c / sum, face};
            continue;
        }
        Wide3<T> from = origin - border.a, along = direction;
        if (border.kind == Kind::tube)
            from.z = along.z = 0;
        T const squared = dot(along, along), half = dot(from, along);
        if (squared == 0)
            continue;
        Wide3<T> const nearest = from - (half / squared) * along;
        T const under = border.b * border.b - dot(nearest, nearest);
        if (under <= 0)
            continue;
        T const reach = root_of(under / squared);
        for (T const t : {-half / squared - reach, -half / squared + reach}) {
            // of a lens's ball only the half that is its sheet bounds anything
            T const side = T(sides_[face] * border.outward) * (from.z + t * along.z);
            if (sides_[face] == 0 || side <= 0)
                met[count++] = {t, face};
        }
    }
    std::sort(met, met + count, [](Meeting const& a, Meeting const& b) { return a.t < b.t; });
    bool inside = false;
    for (std::size_t k = 0; k < count; ++k) {
        T const middle = k + 1 < count ? (met[k].t + met[k + 1].t) / 2 : met[k].t + 1;
        Wide3<T> const p = origin + middle * direction;
        bool now = k + 1 < count;
        for (std::size_t face = 0; face < borders_.size() && now; ++face)
            now = within(face, p);
        if (now == inside || (k + 1 < count && met[k].t == met[k + 1].t))
            continue;
        Wide3<T> const normal = normal_at(met[k].face, origin + met[k].t * direction);
        out.push_back({met[k].t, std::min(met[k].face, first_cap_), now ? 1 : -1, normal});
        inside = now;
    }
}

} // namespace sahl::bench

// Where lines cross the closed exact shapes, against an oracle that only knows what is inside.
#include "geometry/shape_oracle.h"
#include "geometry/solid.h"
#include "support/catch.h"

#include <limits>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon() * 3.0; // m; lines start 3 m away
constexpr double doubtful = 1e-12; // m: nearer to a face the oracle has its own rounding

struct Line {
    dvec3 origin, direction;
    dvec3 at(double t) const { return origin + t * direction; }
};

/// Crossings in order, as a ray finds them that starts outside and toggles at each.
std::vector<SolidCrossing> crossings_of(Solid const& solid, Line const& line) {
    std::vector<SolidCrossing> crossings;
    bool inside = false;
    double from = 0.0;
    while (auto const c = solid.next(line.origin, line.direction, inside, from, rounding)) {
        crossings.push_back(*c);
        inside = !inside;
        from = c->t;
        if (crossings.size() > 8)
            break;
    }
    return crossings;
}

/// Does the line lie inside between crossings 0 and 1, 2 and 3, …, and nowhere else?
bool oracle_agrees(Shape const& shape, Line const& line, std::vector<SolidCrossing> const& crossings) {
    for (int k = 0; k <= 300; ++k) {
        double const t = 6.0 * k / 300.0;
        double const deep = depth(shape, line.at(t));
        std::size_t before = 0;
        while (before < crossings.size() && crossings[before].t < t)
            ++before;
        if (std::abs(deep) > doubtful && (deep > 0.0) != (before % 2 == 1))
            return false;
    }
    return crossings.size() % 2 == 0;
}

/// A line from outside towards a point, 3 m from the middle.
Line towards(Shape const& shape, dvec3 const& point, dvec3 const& direction) {
    double const back = 3.0 + dot(point - middle(shape), direction);
    return {point - back * direction, direction};
}

template <class NextLine>
int wrong_lines(Shape const& shape, int count, NextLine const& next_line) {
    Solid const solid(shape);
    int wrong = 0;
    for (int k = 0; k < count; ++k) {
        Line const line = next_line(solid);
        wrong += !oracle_agrees(shape, line, crossings_of(solid, line));
    }
    return wrong;
}

} // namespace

TEST_CASE("random lines cross a solid where dense sampling says so") {
    Dice dice(1);
    for (auto const& [name, shape] : closed_shapes()) {
        CAPTURE(name);
        CHECK(wrong_lines(shape, 2000, [&, &body = shape](Solid const& solid) {
                  return towards(body, dice.in_box(solid.low(), solid.high()), dice.direction());
              }) == 0);
    }
}

TEST_CASE("lines aimed at edges and corners cross as often as they should") {
    Dice dice(2);
    for (auto const& [name, shape] : closed_shapes()) {
        CAPTURE(name);
        CHECK(wrong_lines(shape, 2000, [&, &body = shape](Solid const&) {
                  dvec3 const off =
                      dice.below(2) ? dvec3(0.0) : dice.log_between(1e-17, 1e-6) * dice.direction();
                  return towards(body, edge_point(body, dice) + off, dice.direction());
              }) == 0);
    }
}

TEST_CASE("lines along an edge, a face or the axis cross as often as they should") {
    Dice dice(3);
    for (auto const& [name, shape] : closed_shapes()) {
        CAPTURE(name);
        CHECK(wrong_lines(shape, 1000, [&, &body = shape](Solid const&) {
                  dvec3 direction = normalize(edge_point(body, dice) - edge_point(body, dice));
                  if (!(length(direction) > 0.5) || dice.below(3) == 0) {
                      direction = dvec3(0.0);
                      direction[static_cast<int>(dice.below(3))] = dice.sign();
                  }
                  return towards(body, edge_point(body, dice), direction);
              }) == 0);
    }
}

TEST_CASE("crossings lie on the surface to a few ulp, and normals point outwards") {
    Dice dice(4);
    for (auto const& [name, shape] : closed_shapes()) {
        Solid const solid(shape);
        double off_surface = 0.0, not_unit = 0.0;
        int inwards = 0;
        for (int k = 0; k < 2000; ++k) {
            Line const line = towards(shape, dice.in_box(solid.low(), solid.high()), dice.direction());
            for (SolidCrossing const& c : crossings_of(solid, line)) {
                dvec3 point = line.at(c.t);
                dvec3 const normal = solid.settle(c.face, point);
                off_surface = std::max(off_surface, std::abs(depth(shape, point)));
                not_unit = std::max(not_unit, std::abs(length(normal) - 1.0));
                inwards += depth(shape, point + 1e-6 * normal) > 0.0;
                inwards += (dot(normal, line.direction) < 0.0) != c.enters && c.slope > 1e-6;
                CHECK(std::abs(std::abs(dot(normal, line.direction)) - c.slope) < 1e-9);
            }
        }
        CAPTURE(name);
        CHECK(off_surface <= 2e-15); // coordinates up to 3 m, whose ulp is 4e-16
        CHECK(not_unit <= 4e-16);
        CHECK(inwards == 0);
    }
}

TEST_CASE("a start is inside where the oracle says so, on the surface it belongs to where it heads") {
    Dice dice(5);
    for (auto const& [name, shape] : closed_shapes()) {
        CAPTURE(name);
        Solid const solid(shape);
        int wrong = 0, wrong_on_face = 0;
        for (int k = 0; k < 2000; ++k) {
            dvec3 const point = dice.in_box(1.2 * solid.low(), 1.2 * solid.high()),
                        direction = dice.direction();
            double const deep = depth(shape, point);
            wrong +=
                std::abs(deep) > doubtful && solid.inside(point, direction, 0.0, rounding) != (deep > 0.0);

            Line const line = towards(shape, dice.in_box(solid.low(), solid.high()), direction);
            auto const c = solid.next(line.origin, line.direction, false, 0.0, rounding);
            if (!c || c->slope < 1e-3)
                continue;
            dvec3 on = line.at(c->t);
            dvec3 const normal = solid.settle(c->face, on);
            dvec3 const leaving = dice.direction();
            double const out = dot(leaving, normal);
            bool const heads_in = depth(shape, on + 1e-9 * leaving) > 0.0;
            if (std::abs(out) > 1e-2 && std::abs(depth(shape, on + 1e-9 * leaving)) > 1e-12)
                wrong_on_face += solid.inside(on, leaving, 0.0, rounding) != heads_in;
        }
        CHECK(wrong == 0);
        CHECK(wrong_on_face == 0);
    }
}

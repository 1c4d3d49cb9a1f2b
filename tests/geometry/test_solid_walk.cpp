// Ten thousand bounces inside every closed shape: the body is never lost, wherever the walk starts, at any
// size and however far from the origin.
#include "geometry/bvh.h"
#include "geometry/shape_oracle.h"
#include "optics/snell.h"
#include "support/catch.h"

#include <limits>

using namespace sahl;
using namespace sahl::bench;

namespace {

struct Room {
    Shape shape;
    Affine to_world, to_local;
    double size; // of one local unit
    double ulp;  // local: of the coordinates that are rounded
    Bvh bvh;

    Room(Shape const& body, Affine const& place, double scale)
        : shape(body), to_world(place), to_local(inverse(place)), size(scale),
          ulp(std::numeric_limits<double>::epsilon() * (3.0 + length(place.offset) / scale)),
          bvh({PlacedGeometry{body, place, {0}, {0}, false, false}}) {}
};

struct Walk {
    int lost = 0, entered = 0, outside = 0, turned = 0;
    double length = 0.0; // local
    dvec3 origin, direction;
};

/// A cone's tip has no normal: how light is reflected there, nobody can say.
bool at_tip(Room const& room, dvec3 const& point) {
    auto const* const cone = std::get_if<Cone>(&room.shape);
    if (!cone || (cone->radius > 0.0 && cone->top_radius > 0.0))
        return false;
    dvec3 const tip(0.0, 0.0, cone->radius > 0.0 ? 0.5 * cone->length : -0.5 * cone->length);
    return length(room.to_local.point(point) - tip) < 1e3 * room.ulp;
}

/// Reflects the ray within the body `bounces` times.
Walk walk(Room const& room, dvec3 const& start, dvec3 const& heading, int bounces) {
    Walk result;
    result.origin = room.to_world.point(start);
    result.direction = normalize(room.to_world.vector(heading));
    ShellSet inside;
    inside.insert({0});
    for (int k = 0; k < bounces; ++k) {
        NextHit const hit = room.bvh.next(result.origin, result.direction, inside, {});
        if (hit.proof != Proof::clean || hit.at_one_place.size() != 1) {
            ++result.lost;
            return result;
        }
        Crossing const& c = hit.at_one_place.front();
        result.entered += c.enters;
        result.length += hit.t / room.size;
        result.origin = c.point;
        if (at_tip(room, c.point))
            return result;
        double const along = dot(c.normal, result.direction);
        result.turned += along < -1e-7; // the outward normal is along travel where a ray leaves
        result.direction = reflect(result.direction, c.normal);
        // rounding may push a point out at an edge, and by no more than rounding
        result.outside += depth(room.shape, room.to_local.point(c.point)) < -64.0 * room.ulp;
    }
    return result;
}

struct Start {
    dvec3 point, heading;
};

/// In the middle; within 1e-8 … 1e-16 of an edge or corner; on a face, leaving it at 1e-1 … 1e-8 rad.
Start draw_start(Room const& room, Dice& dice, int kind) {
    Shape const& shape = room.shape;
    dvec3 const centre = middle(shape), heading = dice.direction();
    if (kind == 0)
        return {centre, heading};
    if (kind == 1)
        for (;;) {
            dvec3 const point = edge_point(shape, dice) + dice.log_between(1e-16, 1e-8) * dice.direction();
            if (depth(shape, point) >= 0.0)
                return {point, heading};
        }
    ShellSet inside;
    inside.insert({0});
    NextHit const hit =
        room.bvh.next(room.to_world.point(centre), normalize(room.to_world.vector(heading)), inside, {});
    REQUIRE(hit.at_one_place.size() == 1);
    dvec3 const normal = normalize(room.to_local.vector(hit.at_one_place.front().normal));
    double const grazing = dice.log_between(1e-8, 1e-1);
    dvec3 const along = perpendicular_to(normal, dice.direction());
    return {room.to_local.point(hit.at_one_place.front().point),
            normalize(std::cos(grazing) * along - std::sin(grazing) * normal)};
}

void walk_everywhere(double scale, double offset, int starts, int bounces) {
    Dice dice(1);
    for (auto const& [name, shape] : closed_shapes()) {
        dmat3 const turn = dice.rotation();
        Affine const place{scale * turn, offset * scale * dice.direction()};
        Room const room(shape, place, scale);
        for (int kind = 0; kind < 3; ++kind)
            for (int k = 0; k < starts; ++k) {
                Start const start = draw_start(room, dice, kind);
                Walk const done = walk(room, start.point, start.heading, bounces);
                CAPTURE(name, scale, offset, kind, k);
                CHECK(done.lost == 0);
                CHECK(done.entered == 0);
                CHECK(done.outside == 0);
                CHECK(done.turned == 0);
            }
    }
}

} // namespace

TEST_CASE("a ray that is reflected inside a body ten thousand times never loses it", "[slow]") {
    walk_everywhere(1.0, 0.0, 4, 10'000);
}

TEST_CASE("nor does it in a body of a micrometre or a kilometre", "[slow]") {
    for (double scale : {1e-6, 1e-3, 1e3})
        walk_everywhere(scale, 0.0, 10, 500);
}

TEST_CASE("nor does it in a body a thousand or a hundred thousand radii away", "[slow]") {
    for (double scale : {1e-6, 1.0, 1e3})
        for (double offset : {1e3, 1e5})
            walk_everywhere(scale, offset, 10, 500);
}

TEST_CASE("a whispering gallery goes round and round") {
    // each bounce at grazing angle a goes on by 2a of the circle; a walk that stalls would not
    for (double offset : {0.0, 1e3})
        for (double grazing : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
            Room const room(Sphere{1.0}, Affine{dmat3(1.0), offset * dvec3(0.6, 0.0, 0.8)}, 1.0);
            // an angle is known no better than the depth below the surface, grazing² / 2, is above its
            // rounding
            if (0.5 * grazing * grazing < 30.0 * room.ulp)
                continue;
            Walk const done = walk(room, {1.0, 0.0, 0.0}, {-std::sin(grazing), std::cos(grazing), 0.0}, 1000);
            CAPTURE(offset, grazing, done.length);
            CHECK(done.lost == 0);
            CHECK(done.length == Approx(1000 * 2.0 * std::sin(grazing)).epsilon(1e-2));
        }
}

// Ray differentials against rays: what a step on the film does is what the neighbouring ray does.
#include "optics/snell.h"
#include "render/footprint.h"
#include "support/catch.h"

#include <cmath>
#include <optional>

using namespace sahl;

namespace {

/// A ray through a ball about the origin, until it meets the plane z = −3 or so: place and direction.
struct Traced {
    dvec3 place, direction;
};

double to_sphere(dvec3 const& origin, dvec3 const& direction, bool far) {
    double const half = dot(origin, direction), c = dot(origin, origin) - 1.0;
    double const root = std::sqrt(half * half - c);
    return -half + (far ? root : -root);
}

dvec3 direction_at(double x) {
    return normalize(dvec3(x - 0.02, 0.06, -1.0));
}

} // namespace

TEST_CASE("ray differentials through a ball and off a mirror are the rays' own", "[render]") {
    dvec3 const from(0.1, 0.05, 4.0);
    double const n = 1.5;
    auto const follow = [&](double x, RayDifferential* differential) {
        dvec3 origin = from, direction = direction_at(x);
        for (bool inside : {false, true}) {
            double const t = to_sphere(origin, direction, inside);
            dvec3 const at = origin + t * direction, normal = inside ? -at : at;
            dvec3 const after = *refract(direction, normal, inside ? n : 1.0, inside ? 1.0 : n);
            if (differential) {
                differential->go(t, direction, normal);
                dvec3 const turn = inside ? -differential->place : differential->place; // of a unit sphere
                differential->refract(direction, after, normal, turn, inside ? n : 1.0, inside ? 1.0 : n);
            }
            origin = at;
            direction = after;
        }
        dvec3 const mirror = normalize(dvec3(0.2, 0.1, 1.0)); // through (0, 0, −3)
        double const t = dot(dvec3(0.0, 0.0, -3.0) - origin, mirror) / dot(direction, mirror);
        if (differential) {
            differential->go(t, direction, mirror);
            differential->reflect(direction, mirror, dvec3(0.0));
        }
        return Traced{origin + t * direction, reflect(direction, mirror)};
    };
    double const step = 1e-6;
    RayDifferential differential;
    differential.heading = (direction_at(step) - direction_at(-step)) / (2.0 * step);
    follow(0.0, &differential);
    Traced const less = follow(-step, nullptr), more = follow(step, nullptr);
    // differences of 1e-6 leave 1e-12 of a third derivative, and 1e-10 of rounding
    CHECK(length(differential.place - (more.place - less.place) / (2.0 * step)) < 1e-8);
    CHECK(length(differential.heading - (more.direction - less.direction) / (2.0 * step)) < 1e-8);
    CHECK(length(differential.place) > 0.1);
}

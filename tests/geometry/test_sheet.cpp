// Open shapes: what they cover, borders included, and where a line meets their plane.
#include "geometry/sheet.h"
#include "support/catch.h"
#include "support/dice.h"

using namespace sahl;
using namespace sahl::bench;

TEST_CASE("a sheet covers its border and nothing beyond") {
    Shape const rectangle = Rectangle{{2.0, 1.0}};
    CHECK((covers(rectangle, 1.0, 0.5) && covers(rectangle, -1.0, -0.5) && covers(rectangle, 0.0, 0.0)));
    CHECK_FALSE(covers(rectangle, std::nextafter(1.0, 2.0), 0.0));
    CHECK_FALSE(covers(rectangle, 0.0, std::nextafter(-0.5, -1.0)));
    Shape const ring = Disk{5.0, 2.5};
    CHECK((covers(ring, 3.0, 4.0) && covers(ring, 0.0, -5.0) && covers(ring, 1.5, 2.0))); // both rims
    CHECK_FALSE((covers(ring, 0.0, 0.0) || covers(ring, 1.4, 2.0) || covers(ring, 3.1, 4.0)));
    CHECK(covers(Disk{5.0}, 0.0, 0.0));
    CHECK(covers(Plane{}, 1e30, -1e30));
    CHECK_FALSE(covers(Sphere{1.0}, 0.0, 0.0)); // closed shapes are no sheets
}

TEST_CASE("a line meets a sheet where it crosses its plane, ahead or behind, if it covers that place") {
    Dice dice(1);
    for (Shape const& sheet : {Shape(Rectangle{{2.0, 1.0}}), Shape(Disk{1.0, 0.4}), Shape(Plane{})})
        for (int k = 0; k < 10'000; ++k) {
            dvec3 const origin = dice.in_box(dvec3(-2.0), dvec3(2.0)),
                        direction = dice.log_between(0.1, 10.0) * dice.direction();
            auto const t = meet(sheet, origin, direction);
            double const expected = -origin.z / direction.z;
            dvec3 const at = origin + expected * direction;
            REQUIRE(t.has_value() == covers(sheet, at.x, at.y));
            if (t)
                REQUIRE(*t == expected);
        }
}

TEST_CASE("a line along a sheet does not meet it") {
    for (double z : {0.0, 1.0, -1e-300})
        for (dvec3 const& direction : {dvec3(1.0, 0.0, 0.0), dvec3(0.6, 0.8, 0.0), dvec3(0.6, -0.8, -0.0)})
            CHECK(!meet(Plane{}, {0.1, 0.2, z}, direction));
    CHECK(meet(Plane{}, {0.0, 0.0, 1.0}, {1.0, 0.0, -1e-12}).value() == Approx(1e12));
}

// What the affine maps and perpendicular_to promise.
#include "math/vec.h"
#include "support/catch.h"
#include "support/dice.h"

using namespace sahl;
using bench::Dice;

namespace {

Affine random_map(Dice& dice) {
    dmat3 linear = dice.rotation();
    for (int column = 0; column < 3; ++column)
        linear[column] *= dice.sign() * dice.log_between(0.1, 10.0);
    return {linear, dice.in_box(dvec3(-10.0), dvec3(10.0))};
}

} // namespace

TEST_CASE("composing maps applies the inner one first") {
    Dice dice(1);
    for (int k = 0; k < 100; ++k) {
        Affine const outer = random_map(dice), inner = random_map(dice);
        dvec3 const p = dice.in_box(dvec3(-1.0), dvec3(1.0));
        CHECK(length(compose(outer, inner).point(p) - outer.point(inner.point(p))) < 1e-12);
        CHECK(length(compose(outer, inner).vector(p) - outer.vector(inner.vector(p))) < 1e-12);
    }
    Affine const move{dmat3(1.0), dvec3(1.0, 0.0, 0.0)}, twice{dmat3(2.0), dvec3(0.0)};
    CHECK(compose(twice, move).point(dvec3(0.0)) == dvec3(2.0, 0.0, 0.0));
    CHECK(compose(move, twice).point(dvec3(0.0)) == dvec3(1.0, 0.0, 0.0));
}

TEST_CASE("the inverse of a map leads back, mirrored maps too") {
    Dice dice(2);
    for (int k = 0; k < 100; ++k) {
        Affine const map = random_map(dice);
        dvec3 const p = dice.in_box(dvec3(-1.0), dvec3(1.0));
        CHECK(length(inverse(map).point(map.point(p)) - p) < 1e-12);
        CHECK(length(map.vector(inverse(map).vector(p)) - p) < 1e-12);
    }
    CHECK(inverse(Affine{}) == Affine{});
}

TEST_CASE("a perpendicular is a unit vector at right angles, nearest to the wished direction") {
    Dice dice(3);
    for (int k = 0; k < 1000; ++k) {
        dvec3 const axis = dice.direction(), up = dice.log_between(1e-6, 1e6) * dice.direction();
        dvec3 const side = perpendicular_to(axis, up);
        CHECK(std::abs(length(side) - 1.0) < 4e-16);
        CHECK(std::abs(dot(side, axis)) < 4e-16);
        CHECK(dot(cross(axis, up), side) == Approx(0.0).margin(1e-9 * length(up)));
        CHECK(dot(side, up) >= 0.0);
    }
}

TEST_CASE("a perpendicular exists where the wish is parallel, absent or nearly parallel") {
    Dice dice(4);
    for (int k = 0; k < 1000; ++k) {
        dvec3 const axis = dice.direction();
        CHECK(std::abs(dot(axis, perpendicular_to(axis))) < 4e-16);
        CHECK(std::abs(dot(axis, perpendicular_to(axis, 3.0 * axis))) < 4e-16);
        CHECK(std::abs(dot(axis, perpendicular_to(axis, -axis))) < 4e-16);
        dvec3 const side = perpendicular_to(axis, axis + dice.log_between(1e-17, 1e-6) * dice.direction());
        CHECK(std::abs(dot(axis, side)) < 4e-16);
        CHECK(std::abs(length(side) - 1.0) < 4e-16);
    }
    for (int i = 0; i < 3; ++i) {
        dvec3 axis(0.0);
        axis[i] = 1.0;
        CHECK(dot(axis, perpendicular_to(axis)) == 0.0);
        CHECK(dot(-axis, perpendicular_to(-axis, axis)) == 0.0);
    }
}

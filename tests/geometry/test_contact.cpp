// Which faces of exact shapes count as one surface: those that were placed to coincide, in any frame, and no
// others, however small the gap.
#include "geometry/bvh.h"
#include "support/catch.h"
#include "support/dice.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace sahl;
using namespace sahl::bench;

namespace {

struct Pair {
    std::string name;
    Shape one, other;
    Affine other_place;          // of the other relative to the one
    std::uint32_t face, touched; // of each; what touches
    std::size_t contacts = 1;
};

Affine at(double x, double y, double z) {
    return {dmat3(1.0), {x, y, z}};
}

/// Turned by half a turn about z.
Affine half_turn(dvec3 const& offset) {
    return {dmat3({-1, 0, 0}, {0, -1, 0}, {0, 0, 1}), offset};
}

std::vector<Pair> touching() {
    double const quarter = std::numbers::pi / 2.0, half_height = 0.05 * std::cos(0.5 * quarter);
    return {
        {"plates", Box{{0.1, 0.1, 0.02}}, Box{{0.05, 0.07, 0.03}}, at(0.01, 0.02, 0.025), 5, 4},
        {"plates side by side", Box{{0.1, 0.1, 0.02}}, Box{{0.3, 0.1, 0.02}}, at(0.2, 0.0, 0.0), 1, 0, 5},
        {"cemented lenses", Lens{0.06, -0.045, 0.006, 0.025}, Lens{-0.045, -0.13, 0.0025, 0.025},
         at(0.0, 0.0, 0.006), 1, 0, 2},
        {"lens on a plate", Lens{0.0, -0.05, 0.004, 0.02}, Box{{0.1, 0.1, 0.01}}, at(0.0, 0.0, -0.005), 0, 5},
        {"halves of a cube", Prism{quarter, 0.1, 0.1}, Prism{quarter, 0.1, 0.1},
         half_turn({0.0, -2.0 * half_height, 0.0}), 2, 2, 3},
        {"a cylinder in a bore", Cylinder{0.01, 0.1}, Cylinder{0.01, 0.02}, at(0.0, 0.0, 0.013), 0, 0},
        {"a ball in a ball", Sphere{0.01}, Sphere{0.01}, at(0.0, 0.0, 0.0), 0, 0},
        {"a ball in a lens", Lens{0.02, 0.0, 0.005, 0.02}, Sphere{0.02}, at(0.0, 0.0, 0.02), 0, 0},
        {"a mirror on a plate", Box{{0.1, 0.1, 0.02}}, Disk{0.01}, at(0.02, 0.0, 0.01), 5, 0},
        {"a detector on a rod", Cylinder{0.01, 0.1}, Rectangle{{0.02, 0.02}}, half_turn({0.0, 0.0, 0.05}), 2,
         0},
        {"a prism on a plane", Prism{quarter, 0.1, 0.1}, Plane{}, at(0.0, 0.0, -0.05), 3, 0},
    };
}

std::size_t contacts_of(Pair const& pair, Affine const& frame, Affine const& nudge,
                        bool expected_one = true) {
    std::vector<PlacedGeometry> geometries;
    geometries.push_back({pair.one, frame, {0}, {0}, false, false});
    geometries.push_back(
        {pair.other, compose(frame, compose(nudge, pair.other_place)), {10}, {1}, false, false});
    Bvh const bvh(std::move(geometries));
    std::pair const wanted(FaceId{pair.face}, FaceId{10 + pair.touched});
    std::pair const turned(wanted.second, wanted.first);
    bool const found = std::any_of(bvh.contacts().begin(), bvh.contacts().end(), [&](auto const& contact) {
        return contact == wanted || contact == turned;
    });
    return found == expected_one ? bvh.contacts().size() : 1000;
}

/// Scaled, turned thrice and moved twice, as groups within groups do.
Affine random_frame(Dice& dice, double far) {
    Affine const inner{dice.rotation(), dice.in_box(dvec3(-0.1), dvec3(0.1))};
    Affine const outer{dice.rotation(), far * dice.direction()};
    Affine const scaled{dmat3(dice.log_between(0.1, 10.0)), dvec3(0.0)};
    return compose(outer, compose(scaled, inner));
}

} // namespace

TEST_CASE("faces that were placed to touch do, in any group") {
    Dice dice(1);
    for (Pair const& pair : touching()) {
        CAPTURE(pair.name);
        CHECK(contacts_of(pair, {}, {}) == pair.contacts);
        for (double far : {0.0, 1.0, 1e3})
            for (int k = 0; k < 50; ++k)
                CHECK(contacts_of(pair, random_frame(dice, far), {}) == pair.contacts);
    }
}

TEST_CASE("a gap is a gap, of a micrometre a metre away, or of a picometre") {
    Dice dice(2);
    for (Pair const& pair : touching()) {
        CAPTURE(pair.name);
        for (double gap : {1e-6, 1e-9, 1e-12}) {
            // away from each other: along z for plates and lenses, along x for sides, sideways for tubes and
            // balls
            dvec3 const along = pair.name == "plates side by side"    ? dvec3(1, 0, 0)
                                : pair.name == "halves of a cube"     ? dvec3(0, -1, 0)
                                : pair.name == "a cylinder in a bore" ? dvec3(1, 0, 0)
                                                                      : dvec3(0, 0, 1);
            CHECK(contacts_of(pair, {}, {dmat3(1.0), gap * along}, false) < 1000);
            // a metre away a picometre is 2000 ulp, and still a gap
            for (int k = 0; k < 20; ++k) {
                Affine const frame{dice.rotation(), dice.direction()};
                CHECK(contacts_of(pair, frame, {dmat3(1.0), gap * along}, false) < 1000);
            }
        }
    }
}

TEST_CASE("faces that only resemble each other do not touch") {
    Pair const same_radius{"", Sphere{0.01}, Cylinder{0.01, 0.1}, {}, 0, 0};
    CHECK(contacts_of(same_radius, {}, {}, false) == 0);
    Pair const tilted{"",
                      Box{{0.1, 0.1, 0.02}},
                      Box{{0.1, 0.1, 0.02}},
                      {dmat3({1, 0, 1e-9}, {0, 1, 0}, {-1e-9, 0, 1}), {0.0, 0.0, 0.02}},
                      5,
                      4};
    CHECK(contacts_of(tilted, {}, {}, false) <= 2);
    Pair const flatter{
        "", Lens{0.06, -0.045, 0.006, 0.025}, Lens{-0.0450001, -0.13, 0.0025, 0.025}, at(0, 0, 0.006), 1, 0};
    CHECK(contacts_of(flatter, {}, {}, false) <= 1);
    Pair const turned_tube{"",
                           Cylinder{0.01, 0.1},
                           Cylinder{0.01, 0.1},
                           {dmat3({1, 0, 0}, {0, 1, 1e-9}, {0, -1e-9, 1}), dvec3(0.0)},
                           0,
                           0};
    CHECK(contacts_of(turned_tube, {}, {}, false) <= 2);
}

TEST_CASE("a sphere that is stretched out of shape touches none, planes still do") {
    Affine const stretch{dmat3({2, 0, 0}, {0, 1, 0}, {0, 0, 1}), dvec3(0.0)};
    std::vector<PlacedGeometry> balls;
    balls.push_back({Shape(Sphere{0.01}), stretch, {0}, {0}, false, false});
    balls.push_back({Shape(Sphere{0.01}), {}, {10}, {1}, false, false});
    CHECK(Bvh(std::move(balls)).contacts().empty());
    std::vector<PlacedGeometry> plates;
    plates.push_back({Shape(Box{{0.1, 0.1, 0.02}}), stretch, {0}, {0}, false, false});
    plates.push_back({Shape(Box{{0.1, 0.1, 0.02}}), at(0.0, 0.0, 0.02), {10}, {1}, false, false});
    CHECK(Bvh(std::move(plates)).contacts().size() == 3); // and top and bottom are flush
}

// The world: many objects, exact and meshes, placed anyhow. Each line's crossings are those that the objects
// have alone; starts, sheets and contradictions are what they should be.
#include "geometry/bvh.h"
#include "geometry/shape_oracle.h"
#include "support/catch.h"
#include "support/meshes.h"

#include <algorithm>
#include <memory>
#include <vector>

using namespace sahl;
using namespace sahl::bench;

namespace {

struct Met {
    double t;
    std::uint32_t object;
    bool enters;
};

/// All crossings of a line that starts outside of all, in the order in which a ray meets them.
std::vector<Met> all_met(Bvh const& bvh, dvec3 const& origin, dvec3 const& direction) {
    std::vector<Met> met;
    ShellSet inside;
    LeftSheets left;
    double from = 0.0;
    while (met.size() < 200) {
        NextHit const hit = bvh.next(origin, direction, inside, left, from);
        if (hit.proof == Proof::leak)
            return {{-1.0, 0, false}};
        if (hit.at_one_place.empty())
            return met;
        for (Crossing const& c : hit.at_one_place) {
            met.push_back({c.t, c.object, c.enters});
            if (c.open)
                left.push_back({c.object, !c.enters});
            else if (c.enters)
                inside.insert(c.shell);
            else
                inside.erase(c.shell);
        }
        from = hit.t;
    }
    return met;
}

/// Shapes, meshes and two sheets, scattered and overlapping, with room for one ray's shells.
std::vector<PlacedGeometry> scattered(Dice& dice, std::size_t count) {
    auto const shapes = closed_shapes();
    auto const mesh = std::make_shared<Mesh const>(make_mesh(torus_soup(0.5, 0.2, 16, 8)));
    std::vector<PlacedGeometry> geometries;
    for (std::uint32_t k = 0; k < count; ++k) {
        Affine const place{dice.log_between(0.05, 0.3) * dice.rotation(),
                           dice.in_box(dvec3(-0.8), dvec3(0.8))};
        FaceId const face{10 * k};
        if (k < 2)
            geometries.push_back({Shape(Disk{1.0}), place, face, {k}, k == 0, false});
        else if (k % 5 == 0)
            geometries.push_back({mesh, place, face, {k}, false, false});
        else
            geometries.push_back({shapes[k % shapes.size()].second, place, face, {k}, false, false});
    }
    return geometries;
}

} // namespace

TEST_CASE("a line through many objects meets each as if it were alone, in order") {
    Dice dice(1);
    for (std::size_t count : {3, 6, 7, 40}) { // below and above where the hierarchy of boxes begins
        std::vector<PlacedGeometry> const geometries = scattered(dice, count);
        Bvh const together(geometries);
        std::vector<Bvh> alone;
        for (PlacedGeometry const& geometry : geometries)
            alone.emplace_back(std::vector<PlacedGeometry>{geometry});
        int wrong = 0, crossings = 0;
        for (int k = 0; k < 500; ++k) {
            dvec3 const direction = dice.direction();
            dvec3 const at =
                geometries[dice.below(count)].to_world.point(dice.in_box(dvec3(-0.5), dvec3(0.5)));
            dvec3 const origin = at - 8.0 * direction;
            std::vector<Met> expected;
            for (std::uint32_t object = 0; object < alone.size(); ++object)
                for (Met const& met : all_met(alone[object], origin, direction))
                    expected.push_back({met.t, object, met.enters});
            std::sort(expected.begin(), expected.end(), [](Met const& a, Met const& b) { return a.t < b.t; });
            std::vector<Met> const found = all_met(together, origin, direction);
            crossings += static_cast<int>(found.size());
            wrong += !std::equal(found.begin(), found.end(), expected.begin(), expected.end(),
                                 [](Met const& a, Met const& b) {
                                     return a.t == b.t && a.object == b.object && a.enters == b.enters;
                                 });
        }
        CAPTURE(count);
        CHECK(wrong == 0);
        CHECK(crossings > 100);
    }
}

TEST_CASE("a start among many objects is in those that its point is in") {
    Dice dice(2);
    std::vector<PlacedGeometry> const geometries = scattered(dice, 40);
    Bvh const bvh(geometries);
    int wrong = 0, nested = 0;
    for (int k = 0; k < 8000; ++k) {
        dvec3 const point = dice.in_box(dvec3(-0.8), dvec3(0.8));
        Bvh::Start const start = bvh.start_at(point, dice.direction());
        CHECK(start.fits);
        CHECK(start.on.empty());
        for (std::uint32_t object = 2; object < geometries.size(); ++object) {
            dvec3 const local = inverse(geometries[object].to_world).point(point);
            auto const* const shape = std::get_if<Shape>(&geometries[object].geometry);
            double const across =
                std::hypot(std::hypot(local.x, local.y) - 0.5, local.z); // of the torus: not near its facets
            bool const near = !shape && across > 0.17 && across < 0.21;
            wrong += !near &&
                     start.inside.contains({object}) != (shape ? depth(*shape, local) > 0.0 : across < 0.2);
            nested += start.inside.contains({object});
        }
    }
    CHECK(wrong == 0);
    CHECK(nested > 100);
}

TEST_CASE("a start on a sheet is on the side that it heads for") {
    Affine const place{dmat3(1.0), {0.0, 0.0, 0.3}};
    Bvh const bvh(std::vector<PlacedGeometry>{{Shape(Disk{1.0, 0.5}), place, {0}, {0}, false, false},
                                              {Shape(Plane{}), place, {1}, {0}, false, false}});
    for (double up : {1.0, -1.0}) {
        Bvh::Start const start = bvh.start_at({0.7, 0.0, 0.3}, {0.0, 0.0, up});
        REQUIRE(start.on.size() == 2);
        CHECK(bool(start.on[0].above) == (up > 0.0));
        CHECK(bvh.next({0.7, 0.0, 0.3}, {0.0, 0.0, up}, {}, start.on).at_one_place.empty());
    }
    CHECK(bvh.start_at({0.2, 0.0, 0.3}, {0.0, 0.0, 1.0}).on.size() == 1); // in the hole
    CHECK(bvh.start_at({0.2, 0.0, 0.3 + 1e-12}, {0.0, 0.0, 1.0}).on.empty());
    CHECK(bvh.bounds().first == dvec3(-1.0, -1.0, 0.3)); // of what is bounded
}

TEST_CASE("what contradicts the shells that a ray is in is a leak") {
    Bvh const bvh(std::vector<PlacedGeometry>{
        {Shape(Sphere{1.0}), {}, {0}, {0}, false, false},
        {Shape(Sphere{1.0}), {dmat3(1.0), {5.0, 0.0, 0.0}}, {1}, {1}, false, false}});
    ShellSet first;
    first.insert({0});
    dvec3 const z(0.0, 0.0, 1.0);
    CHECK(bvh.next({0.0, 0.0, 0.0}, z, first, {}).proof == Proof::clean);
    CHECK(bvh.next({0.0, 0.0, 3.0}, z, first, {}).proof == Proof::leak); // said to be in it, is beyond it
    CHECK(bvh.next({2.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, first, {}).proof == Proof::leak); // and meets another
    CHECK(bvh.next({0.0, 0.0, 3.0}, z, {}, {}).proof == Proof::clean);
    ShellSet unknown;
    unknown.insert({7});
    CHECK(bvh.next({0.0, 0.0, 3.0}, z, unknown, {}).proof == Proof::leak);
}

TEST_CASE("instances of one mesh have shells of their own, mirrored ones too") {
    auto const mesh = std::make_shared<Mesh const>(make_mesh(ball_soup(1.0, 2)));
    Affine const mirrored{dmat3({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}), {3.0, 0.0, 0.0}};
    Bvh const bvh(std::vector<PlacedGeometry>{{mesh, {}, {0}, {0}, false, false},
                                              {mesh, mirrored, {1}, {1}, false, false}});
    std::vector<Met> const met = all_met(bvh, {-3.0, 0.1, 0.05}, {1.0, 0.0, 0.0});
    REQUIRE(met.size() == 4);
    for (std::size_t k = 0; k < 4; ++k)
        CHECK((met[k].object == k / 2 && met[k].enters == (k % 2 == 0)));
    for (double x : {0.0, 3.0}) {
        ShellSet const inside = bvh.start_at({x, 0.0, 0.0}, {0.0, 0.6, 0.8}).inside;
        CHECK((inside.contains({0}) == (x == 0.0) && inside.contains({1}) == (x == 3.0)));
        NextHit const hit = bvh.next({x, 0.0, 0.0}, {0.0, 0.6, 0.8}, inside, {});
        REQUIRE(hit.at_one_place.size() == 1);
        CHECK(dot(hit.at_one_place.front().normal, {0.0, 0.6, 0.8}) > 0.9); // outwards
    }
}

TEST_CASE("stretched bodies are met where their equation says") {
    // a sphere stretched to an ellipsoid; the normal is the gradient's
    Dice dice(3);
    dvec3 const axes(1.0, 0.5, 2.0);
    Affine const place{dmat3({axes.x, 0, 0}, {0, axes.y, 0}, {0, 0, axes.z}), {1.0, 2.0, 3.0}};
    Bvh const bvh(std::vector<PlacedGeometry>{{Shape(Sphere{1.0}), place, {0}, {0}, false, false}});
    for (int k = 0; k < 1000; ++k) {
        dvec3 const direction = dice.direction(),
                    inner = place.point(0.9 * dice.uniform() * dice.direction());
        NextHit const hit = bvh.next(inner - 10.0 * direction, direction, {}, {});
        REQUIRE(hit.at_one_place.size() == 1);
        Crossing const& c = hit.at_one_place.front();
        dvec3 const scaled = (c.point - place.offset) / axes;
        CHECK(std::abs(length(scaled) - 1.0) < 1e-14);
        CHECK(length(c.normal - normalize(scaled / axes)) < 1e-13);
        CHECK(c.t == Approx(length(c.point - inner + 10.0 * direction)).epsilon(1e-13));
    }
}

// Mirrors and detectors, alone, glued to bodies, on each other, and at the apex of a wedge: each is met once,
// from the right side and in the right order.
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"

#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// The events that ended the segments of one ray, in the order of the log.
std::vector<Event> story(Traced const& traced, std::uint64_t ray = 0) {
    std::vector<Event> events;
    for (Segment const& segment : traced.segments())
        if (segment.ray == ray)
            events.push_back(segment.ended);
    return events;
}

/// A rod along z from 0 to 1 m, of index 1.5, with a ray along its axis from within.
Lab rod_lab() {
    Lab lab;
    lab.body("rod", Cylinder{0.1, 1.0}, lab.medium(1.5), moved({0.0, 0.0, 0.5}));
    lab.rays({{{0.0, 0.0, 0.2}, {0.0, 0.0, 1.0}}});
    return lab;
}

Affine turned_lab(Dice& dice) {
    return {dice.rotation(), dice.in_box(dvec3(-1.0), dvec3(1.0))};
}

/// The whole experiment moved: what must not matter.
void move_all(Experiment& experiment, Affine const& to_world) {
    for (ObjectSpec& object : experiment.objects)
        object.to_world = compose(to_world, object.to_world);
    for (DetectorSpec& detector : experiment.detectors)
        detector.to_world = compose(to_world, detector.to_world);
    for (SourceSpec& source : experiment.sources)
        for (RaySpec& ray : std::get<ExplicitRays>(source.emitter).rays)
            ray = {to_world.point(ray.origin), normalize(to_world.vector(ray.direction)), ray.weight};
}

} // namespace

TEST_CASE("a passing detector glued to a rod's end counts light once, before the rod's face") {
    Dice dice(1);
    for (int k = 0; k < 50; ++k) {
        Lab lab = rod_lab();
        lab.detector("glued", facing({0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}), {0.2, 0.2}, false);
        if (k > 0)
            move_all(lab.experiment, turned_lab(dice));
        lab.experiment.trace.max_depth = 2; // passed, refracted: what is reflected is cut
        Traced const traced = trace(lab);
        REQUIRE(traced.result.hits.size() == 1);
        CHECK(traced.result.hits[0].power == 1.0); // inside, before anything is reflected
        CHECK(story(traced) == std::vector<Event>{Event::passed, Event::refracted, Event::escaped,
                                                  Event::passed, Event::cut_depth});
        CHECK(traced.segments()[1].length < 1e-15);
    }
}

TEST_CASE("light that is reflected at a rod's end does not meet the detector glued there from behind twice") {
    Lab lab = rod_lab();
    lab.detector("glued", facing({0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}), {0.2, 0.2}, false).back = true;
    Traced const traced = trace(lab);
    // passes going out, and again what comes back from the end: 4 % each time of what is inside
    REQUIRE(traced.result.hits.size() >= 2);
    CHECK(traced.result.hits[0].power == 1.0);
    CHECK(traced.result.hits[1].power == Approx(0.04).epsilon(1e-12));
    CHECK(traced.ended(Event::leak) == 0);
}

TEST_CASE("an absorbing detector glued to a rod's end takes all") {
    Dice dice(2);
    for (int k = 0; k < 50; ++k) {
        Lab lab = rod_lab();
        lab.detector("glued", facing({0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}), {0.2, 0.2});
        if (k > 0)
            move_all(lab.experiment, turned_lab(dice));
        Traced const traced = trace(lab);
        CHECK(story(traced) == std::vector<Event>{Event::detected});
        CHECK(traced.watts(traced.result.tally.detected) == 1.0);
    }
}

TEST_CASE("detector, mirror and body at one place are met in this order") {
    Dice dice(3);
    for (int k = 0; k < 50; ++k) {
        Lab lab = rod_lab();
        lab.sheet("mirror", Disk{0.1}, lab.surface(Shares{1.0, 0.0}), moved({0.0, 0.0, 1.0}));
        lab.detector("glued", facing({0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}), {0.2, 0.2}, false);
        lab.experiment.trace.max_depth = 3; // passed, reflected, passed from behind, gone to the other end
        if (k > 0)
            move_all(lab.experiment, turned_lab(dice));
        Traced const traced = trace(lab);
        CHECK(traced.result.hits.size() == 1); // from behind it does not count
        REQUIRE(traced.segments().size() >= 4);
        CHECK(traced.segments()[0].ended == Event::passed);
        CHECK(traced.segments()[1].ended == Event::reflected);
        CHECK(traced.segments()[1].surface == static_cast<std::int32_t>(traced.face("mirror").value));
        CHECK(traced.segments()[2].ended == Event::passed);
        CHECK(traced.segments()[3].ended == Event::refracted); // at the other end
        CHECK(traced.segments()[3].length == Approx(1.0));
    }
}

TEST_CASE("a mirror cemented to a lens's plane face acts in place of that boundary, from both sides") {
    Dice dice(4);
    for (int k = 0; k < 50; ++k) {
        Lab lab;
        lab.body("lens", Lens{0.0, -2.0, 0.1, 0.4}, lab.medium(1.5));
        lab.sheet("mirror", Disk{0.2}, lab.surface(Shares{1.0, 0.0}));
        lab.rays({{{0.05, 0.0, -1.0}, {0.0, 0.0, 1.0}}, {{0.05, 0.0, 1.0}, {0.0, 0.0, -1.0}}});
        if (k > 0)
            move_all(lab.experiment, turned_lab(dice));
        Traced const traced = trace(lab);
        CHECK(story(traced, 0) == std::vector<Event>{Event::reflected, Event::escaped});
        auto const inner = story(traced, 1);
        REQUIRE(inner.size() > 3);
        CHECK(inner[0] == Event::refracted); // into the lens; then the mirror, then out again
        CHECK(inner[1] == Event::reflected);
        CHECK(traced.ended(Event::leak) == 0);
        for (Segment const& s : traced.segments())
            CHECK_FALSE((s.ended == Event::refracted &&
                         s.surface == static_cast<std::int32_t>(traced.face("lens.front").value)));
    }
}

TEST_CASE("a ray that starts on a mirror or a detector does not meet it") {
    Dice dice(5);
    for (int k = 0; k < 200; ++k) {
        Lab lab;
        dvec3 const up(0.0, 0.0, k % 2 ? 1.0 : -1.0);
        lab.sheet("mirror", Rectangle{{1.0, 1.0}}, lab.surface(Shares{1.0, 0.0}));
        lab.detector("detector", moved({2.0, 0.0, 0.0}), {1.0, 1.0}).back = true;
        dvec3 const tilt = normalize(up + dice.between(0.0, 0.3) * dice.direction());
        lab.rays({{{0.1, 0.2, 0.0}, tilt}, {{2.1, 0.2, 0.0}, tilt}});
        move_all(lab.experiment, turned_lab(dice));
        Traced const traced = trace(lab);
        CHECK(story(traced, 0) == std::vector<Event>{Event::escaped});
        CHECK(story(traced, 1) == std::vector<Event>{Event::escaped});
    }
}

TEST_CASE("in a wedge of two mirrors no ray slips through, however near the apex it comes") {
    // unfolding: a ray leaves a wedge of angle α after ⌈π/α⌉ reflections at most, and stays in it
    Dice dice(6);
    for (double apex_deg : {90.0, 60.0, 45.0, 30.0, 20.0}) {
        double const apex = apex_deg * std::numbers::pi / 180.0;
        for (int k = 0; k < 300; ++k) {
            Lab lab;
            SurfaceId const silver = lab.surface(Shares{1.0, 0.0});
            // both mirrors run through the apex, the z axis; the wedge lies between azimuth 0 and α
            lab.sheet("floor", Rectangle{{4.0, 4.0}}, silver, facing({1.9, 0.0, 0.0}, {0.0, 1.0, 0.0}));
            dvec3 const wall(std::cos(apex), std::sin(apex), 0.0);
            lab.sheet("wall", Rectangle{{4.0, 4.0}}, silver,
                      facing(1.9 * wall, {wall.y, -wall.x, 0.0}, {0.0, 0.0, 1.0}));
            double const inside = dice.between(0.05, 0.95) * apex;
            dvec3 const from(std::cos(inside), std::sin(inside), 0.1 * dice.uniform());
            double const near = k % 10 ? dice.log_between(1e-18, 1e-13) : 0.0,
                         target = dice.between(0.0, 1.0) * apex;
            lab.rays({{from, normalize(near * dvec3(std::cos(target), std::sin(target), 0.0) - from)}});
            if (k % 2)
                move_all(lab.experiment, turned_lab(dice));
            Traced const traced = trace(lab);
            CAPTURE(apex_deg, k, near);
            CHECK(traced.result.tally.segments() <= std::ceil(180.0 / apex_deg) + 2);
            CHECK(traced.ended(Event::escaped) == 1);
            // it leaves between floor and wall, of which it hits each from its +z alone
            for (ObjectSpec const& mirror : lab.experiment.objects)
                CHECK(dot(traced.segments().back().direction, mirror.to_world.linear[2]) >= -1e-12);
        }
    }
}

TEST_CASE(
    "six detectors at one place each count a ray once, more than can be kept apart is an error, not a loop") {
    for (std::size_t count : {2, 6, 7, 8, 9, 12, 17, 40}) {
        Lab lab;
        for (std::size_t i = 0; i < count; ++i)
            lab.detector("d" + std::to_string(i), facing({0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}), {1.0, 1.0},
                         false);
        lab.rays({{{0.1, 0.0, 0.0}, normalize(dvec3(0.1, 0.2, 1.0))}});
        Traced const traced = trace(lab);
        if (count <= 7) {
            REQUIRE(traced.result.hits.size() == count);
            for (std::size_t i = 0; i < count; ++i)
                CHECK(traced.result.hits[i].detector.value == i);
            CHECK(traced.ended(Event::escaped) == 1);
        } else {
            CHECK(traced.ended(Event::invalid) == 1);
            CHECK(traced.watts(traced.result.tally.error) == 1.0);
        }
    }
}

TEST_CASE(
    "of bodies that begin at one place the one that counts is met, or the ray is invalid, never another") {
    for (std::size_t count : {2, 8, 9, 15, 17, 40}) {
        Lab lab;
        for (std::size_t i = 0; i < count; ++i) // the last has the highest priority
            lab.body("b" + std::to_string(i), Box{{1.0, 1.0, 1.0}}, lab.medium(1.1 + 0.05 * double(i)),
                     moved({0.0, 0.0, 0.5}), static_cast<int>(i));
        lab.rays({{{0.1, 0.2, -1.0}, {0.0, 0.0, 1.0}}});
        Traced const traced = trace(lab);
        CAPTURE(count);
        REQUIRE(traced.segments().size() > 0);
        if (count <= 8) {
            CHECK(traced.ended(Event::invalid) == 0);
            CHECK(traced.segments()[0].ended == Event::refracted);
            CHECK(traced.segments()[1].optical_path - 1.0 ==
                  Approx(1.1 + 0.05 * double(count - 1)).epsilon(1e-12));
        } else {
            CHECK(traced.segments().size() == 1);
            CHECK(traced.ended(Event::invalid) == 1);
            CHECK(traced.watts(traced.result.tally.error) == 1.0);
        }
    }
}

// What bodies that touch, overlap or nest make of a ray: how many events, and between which media.
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"

#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// The media along the first ray's path where it goes straight through: reflections are dropped.
std::vector<std::uint32_t> media_on_the_way(Traced const& traced) {
    std::vector<std::uint32_t> media;
    std::int32_t next = -1;
    for (Segment const& segment : traced.segments())
        if (segment.parent == next && segment.born != Event::reflected) {
            media.push_back(segment.medium);
            next = static_cast<std::int32_t>(segment.index);
        }
    return media;
}

std::vector<std::uint32_t> numbers(std::initializer_list<MediumId> media) {
    std::vector<std::uint32_t> all;
    for (MediumId medium : media)
        all.push_back(medium.value);
    return all;
}

/// In a random group, what is along z is no longer along any axis.
void turn(Lab& lab, Dice& dice) {
    Affine const group{dice.rotation(), dice.in_box(dvec3(-1.0), dvec3(1.0))};
    for (ObjectSpec& object : lab.experiment.objects)
        object.to_world = compose(group, object.to_world);
    for (SourceSpec& source : lab.experiment.sources)
        for (RaySpec& ray : std::get<ExplicitRays>(source.emitter).rays)
            ray = {group.point(ray.origin), normalize(group.vector(ray.direction)), ray.weight};
}

constexpr MediumId air{0};

/// As it is, and in twenty groups.
template <class Make, class Holds>
void in_any_group(Make const& make, Holds const& holds) {
    Dice dice(1);
    for (int k = 0; k < 21; ++k) {
        Lab lab = make();
        if (k > 0)
            turn(lab, dice);
        CAPTURE(k);
        holds(trace(lab));
    }
}

/// Two 45° prisms, base to base: a cube cut along its diagonal. Light meets the cut at 45°.
Lab cube_of_prisms(double gap, double second_index) {
    Lab lab;
    double const apex = std::numbers::pi / 2.0, height = std::sqrt(0.5);
    Affine const below{dmat3({-1, 0, 0}, {0, -1, 0}, {0, 0, 1}), {0.0, -height - gap, 0.0}};
    lab.body("first", Prism{apex, 1.0, 1.0}, lab.medium(1.5));
    lab.body("second", Prism{apex, 1.0, 1.0}, second_index == 1.5 ? MediumId{1} : lab.medium(second_index),
             below);
    dvec3 const along = normalize(dvec3(1.0, -1.0, 0.0)); // through the left face, upright on it
    lab.rays({{dvec3(0.05, -0.5 * height, 0.03) - 2.0 * along, along}});
    lab.experiment.trace.min_power = 1e-3;
    return lab;
}

} // namespace

TEST_CASE("two 45° prisms a micrometre apart reflect all, in contact they transmit all") {
    in_any_group([] { return cube_of_prisms(1e-6, 1.5); },
                 [](Traced const& traced) {
                     CHECK(traced.ended(Event::total_internal) > 0);
                     REQUIRE(traced.segments().size() > 2);
                     CHECK(traced.segments()[1].ended == Event::total_internal);
                 });
    in_any_group([] { return cube_of_prisms(0.0, 1.5); },
                 [](Traced const& traced) {
                     CHECK(traced.ended(Event::total_internal) == 0);
                     CHECK(media_on_the_way(traced) == numbers({air, {1}, air})); // the cut is no event
                 });
    in_any_group([] { return cube_of_prisms(0.0, 1.6); },
                 [](Traced const& traced) {
                     CHECK(traced.ended(Event::leak) == 0);
                     CHECK(media_on_the_way(traced) == numbers({air, {1}, {2}, air})); // one event at the cut
                     CHECK(traced.segments()[1].ended == Event::refracted);
                 });
}

TEST_CASE("what is placed in contact has one boundary, what is a picometre apart has two") {
    for (double gap : {0.0, 1e-12, 1e-6}) {
        auto const check = [&](Traced const& traced) {
            auto const expected =
                gap == 0.0 ? numbers({air, {1}, {2}, air}) : numbers({air, {1}, air, {2}, air});
            CHECK(media_on_the_way(traced) == expected);
            CHECK(traced.ended(Event::leak) == 0);
        };
        dvec3 const down = normalize(dvec3(0.1, -0.07, 1.0)), from(-0.02, 0.03, -1.0);
        in_any_group( // plates
            [&] {
                Lab lab;
                lab.body("one", Box{{1.0, 1.0, 0.1}}, lab.medium(1.5), moved({0.0, 0.0, -0.05}));
                lab.body("two", Box{{0.8, 0.9, 0.2}}, lab.medium(1.7), moved({0.0, 0.0, 0.1 + gap}));
                lab.rays({{from, down}});
                return lab;
            },
            check);
        in_any_group( // a cemented doublet; its faces are spheres
            [&] {
                Lab lab;
                lab.body("crown", Lens{0.6, -0.45, 0.06, 0.25}, lab.medium(1.5));
                lab.body("flint", Lens{-0.45, -1.3, 0.025, 0.25}, lab.medium(1.7),
                         moved({0.0, 0.0, 0.06 + gap}));
                lab.rays({{{-0.05, 0.03, -1.0}, normalize(dvec3(0.02, 0.01, 1.0))}});
                return lab;
            },
            check);
        in_any_group( // a lens on a plate
            [&] {
                Lab lab;
                lab.body("plate", Box{{1.0, 1.0, 0.1}}, lab.medium(1.5), moved({0.0, 0.0, -0.05}));
                lab.body("lens", Lens{0.0, -0.5, 0.04, 0.2}, lab.medium(1.7), moved({0.0, 0.0, gap}));
                lab.rays({{{0.01, 0.02, -1.0}, {0.0, 0.0, 1.0}}});
                return lab;
            },
            check);
    }
}

TEST_CASE("three bodies that meet at one place make one boundary for each ray") {
    in_any_group(
        [] {
            Lab lab;
            lab.body("below", Box{{1.0, 1.0, 0.1}}, lab.medium(1.5), moved({0.0, 0.0, -0.05}));
            lab.body("left", Box{{0.5, 1.0, 0.1}}, lab.medium(1.6), moved({-0.25, 0.0, 0.05}));
            lab.body("right", Box{{0.5, 1.0, 0.1}}, lab.medium(1.7), moved({0.25, 0.0, 0.05}));
            lab.rays({{{0.1, 0.0, -1.0}, {0.0, 0.0, 1.0}}});
            return lab;
        },
        [](Traced const& traced) {
            CHECK(media_on_the_way(traced) == numbers({air, {1}, {3}, air}));
        });
}

TEST_CASE("where bodies overlap the one of higher priority is there, at equal priority the later") {
    for (int priority : {-1, 0, 1})
        in_any_group(
            [&] {
                Lab lab;
                lab.body("glass", Box{{1.0, 1.0, 0.2}}, lab.medium(1.5));
                lab.body("liquid", Box{{0.5, 0.5, 0.2}}, lab.medium(1.33), moved({0.0, 0.0, 0.1}), priority);
                lab.rays({{{0.1, 0.0, -1.0}, {0.0, 0.0, 1.0}}});
                return lab;
            },
            [&](Traced const& traced) {
                CHECK(media_on_the_way(traced) == numbers({air, {1}, {2}, air}));
                double const cut = priority < 0 ? 0.1 : 0.0; // where the one ends, or the other begins
                CHECK(traced.segments()[1].length == Approx(0.1 + cut));
            });
}

TEST_CASE("liquid in a glass is one boundary, whether it overlaps the wall or fills the bore exactly") {
    for (double liquid_radius : {0.04, 0.045}) // of the bore; into the wall
        in_any_group(
            [&] {
                Lab lab;
                lab.body("glass", Cylinder{0.05, 0.2}, lab.medium(1.5));
                lab.body("bore", Cylinder{0.04, 0.2}, air, moved({0.0, 0.0, 0.01}), 2);
                lab.body("liquid", Cylinder{liquid_radius, 0.1}, lab.medium(1.33), moved({0.0, 0.0, -0.04}),
                         liquid_radius > 0.04 ? 1 : 3);
                lab.rays({{{-1.0, 0.003, -0.05}, {1.0, 0.0, 0.0}}});
                return lab;
            },
            [&](Traced const& traced) {
                CHECK(traced.ended(Event::leak) == 0);
                if (liquid_radius == 0.04)
                    CHECK(media_on_the_way(traced) == numbers({air, {1}, {2}, {1}, air}));
                else // the bore's air is above the liquid's priority: a ring of liquid in the wall
                    CHECK(media_on_the_way(traced) == numbers({air, {1}, {2}, air, {2}, {1}, air}));
            });
}

TEST_CASE(
    "bodies of one medium in contact make no event, bodies of equal index make one that reflects nothing") {
    for (bool same : {true, false})
        in_any_group(
            [&] {
                Lab lab;
                MediumId const glass = lab.medium(1.5);
                lab.body("one", Box{{1.0, 1.0, 0.1}}, glass, moved({0.0, 0.0, -0.05}));
                lab.body("two", Box{{1.0, 1.0, 0.1}}, same ? glass : lab.medium(1.5),
                         moved({0.0, 0.0, 0.05}));
                lab.rays({{{0.1, 0.0, -1.0}, normalize(dvec3(0.1, 0.3, 1.0))}});
                lab.experiment.trace.min_power = 0.5; // what reflects is cut
                return lab;
            },
            [&](Traced const& traced) {
                CHECK(traced.ended(Event::refracted) == (same ? 2 : 3));
                CHECK(traced.ended(Event::cut_power) == 2); // at the outer faces alone
                CHECK(traced.ended(Event::leak) == 0);
            });
}

TEST_CASE(
    "on a shared face the surface of the body of higher priority counts, else of the only one that has one") {
    for (int priority : {0, 1})
        for (bool both : {false, true})
            in_any_group(
                [&] {
                    Lab lab;
                    SurfaceId const mirror = lab.surface(Shares{1.0, 0.0}), black = lab.surface(Absorber{});
                    lab.body("one", Box{{1.0, 1.0, 0.1}}, lab.medium(1.5), moved({0.0, 0.0, -0.05}), priority)
                        .faces = {{"front", mirror}};
                    ObjectSpec& two =
                        lab.body("two", Box{{1.0, 1.0, 0.1}}, lab.medium(1.7), moved({0.0, 0.0, 0.05}));
                    if (both)
                        two.faces = {{"back", black}};
                    lab.rays({{{0.1, 0.0, -1.0}, {0.0, 0.0, 1.0}}});
                    return lab;
                },
                [&](Traced const& traced) {
                    bool const mirrors = !both || priority == 1; // at equal priority the later
                    CHECK((traced.ended(Event::reflected) > 0) == mirrors);
                    CHECK((traced.ended(Event::absorbed) > 0) == !mirrors);
                });
}

// The tree of a ray as it is logged: order, parents, events, cuts and losses; and that it depends on nothing
// but the ray.
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// Three bodies, one of which absorbs, a mirror, a passing and an absorbing detector, and rays from all over.
Lab crowded(int rays) {
    Lab lab;
    Dice dice(1);
    lab.body("ball", Sphere{0.3}, lab.medium(1.5));
    lab.body("box", Box{{0.5, 0.4, 0.3}}, lab.medium(1.7, 2.0), moved({0.5, 0.2, 0.1}));
    lab.body("lens", Lens{0.6, -0.5, 0.2, 0.5}, lab.medium(1.6), {dice.rotation(), {-0.6, 0.0, 0.0}});
    lab.sheet("mirror", Disk{0.4}, lab.surface(Shares{0.9, 0.0}), facing({0.0, 0.8, 0.0}, {0.1, -1.0, 0.0}));
    lab.detector("screen", facing({0.0, 0.0, 2.0}, {0.0, 0.0, -1.0}), {2.0, 2.0});
    lab.detector("window", facing({0.0, 0.0, 0.6}, {0.0, 0.0, -1.0}), {1.0, 1.0}, false);
    std::vector<RaySpec> specs;
    for (int k = 0; k < rays; ++k)
        specs.push_back({dice.in_box(dvec3(-1.0), dvec3(1.0)), dice.direction()});
    lab.rays(specs);
    lab.experiment.trace.min_power = 1e-4;
    return lab;
}

bool same(Segment const& a, Segment const& b) {
    return a.ray == b.ray && a.index == b.index && a.parent == b.parent && a.depth == b.depth &&
           a.born == b.born && a.ended == b.ended && a.surface == b.surface && a.medium == b.medium &&
           a.origin == b.origin && a.direction == b.direction && a.length == b.length &&
           a.optical_path == b.optical_path && a.power_start == b.power_start && a.power_end == b.power_end;
}

dvec3 end_of(Segment const& s) {
    return s.origin + s.length * s.direction;
}

} // namespace

TEST_CASE("a log runs by ray, then breadth first, by parent, refracted before reflected") {
    Traced const traced = trace(crowded(300));
    auto const& log = traced.segments();
    REQUIRE(log.size() > 1000);
    int wrong = 0;
    for (std::size_t i = 0; i < log.size(); ++i) {
        Segment const& s = log[i];
        bool const first = i == 0 || log[i - 1].ray != s.ray;
        wrong += s.index != (first ? 0 : log[i - 1].index + 1);
        wrong += first != (s.parent == -1);
        wrong += first ? s.depth != 0 || s.born != Event::emitted || (i > 0 && s.ray != log[i - 1].ray + 1)
                       : s.depth < log[i - 1].depth;
        if (!first)
            wrong += s.parent < log[i - 1].parent ||
                     (s.parent == log[i - 1].parent &&
                      !(log[i - 1].born == Event::refracted && s.born == Event::reflected));
    }
    CHECK(wrong == 0);
}

TEST_CASE("a child begins where its parent ends, with the power, medium and events that belong together") {
    Traced const traced = trace(crowded(300));
    std::map<std::pair<std::uint64_t, std::int32_t>, Segment const*> by_index;
    std::map<Segment const*, int> children;
    for (Segment const& s : traced.segments())
        by_index[{s.ray, static_cast<std::int32_t>(s.index)}] = &s;
    int wrong = 0;
    double worst = 0.0;
    for (Segment const& s : traced.segments()) {
        if (s.parent < 0)
            continue;
        Segment const& parent = *by_index.at({s.ray, s.parent});
        ++children[&parent];
        wrong += s.depth != parent.depth + 1;
        worst = std::max(worst, length(end_of(parent) - s.origin));
        bool const straight = s.born == Event::passed;
        wrong += straight && (s.direction != parent.direction || s.medium != parent.medium ||
                              parent.ended != Event::passed);
        wrong +=
            s.born == Event::refracted && (s.medium == parent.medium || parent.ended != Event::refracted);
        wrong += (s.born == Event::reflected || s.born == Event::total_internal) && s.medium != parent.medium;
        wrong += s.born == Event::total_internal && parent.ended != Event::total_internal;
        wrong += s.power_start > parent.power_end * (1.0 + 1e-15);
    }
    for (Segment const& s : traced.segments()) {
        int const count = children.count(&s) ? children.at(&s) : 0;
        bool const ends = s.ended == Event::escaped || s.ended == Event::detected ||
                          s.ended == Event::cut_power || s.ended == Event::cut_depth;
        wrong += ends != (count == 0);
        wrong += s.ended == Event::refracted && count != 2;
        wrong += (s.ended == Event::cut_power || s.ended == Event::cut_depth) &&
                 (s.length != 0.0 || s.surface != -1);
        wrong += s.ended == Event::escaped && (s.length != INFINITY || s.surface != -1);
        wrong += s.power_end > s.power_start;
    }
    CHECK(wrong == 0);
    CHECK(worst < 1e-14); // rounding of coordinates of about a metre
    CHECK(traced.ended(Event::leak) + traced.ended(Event::invalid) == 0);
}

TEST_CASE("the ledger closes, and its events are the log's") {
    for (BranchPolicy policy : {BranchPolicy::split, BranchPolicy::roulette, BranchPolicy::dominant}) {
        Lab lab = crowded(300);
        lab.experiment.trace.branch = policy;
        Traced const traced = trace(lab);
        Tally const& tally = traced.result.tally;
        CHECK(std::abs(tally.remainder()) < 1e-13);
        CHECK(tally.segments() == traced.segments().size());
        for (std::size_t event = 0; event < tally.ended.size(); ++event)
            CHECK(tally.ended[event] ==
                  static_cast<std::uint64_t>(std::count_if(
                      traced.segments().begin(), traced.segments().end(),
                      [&](Segment const& s) { return static_cast<std::size_t>(s.ended) == event; })));
        ExactSum at_faces, in_bodies;
        for (ExactSum const& face : tally.absorbed_at_face)
            at_faces.add(face);
        for (ExactSum const& body : tally.absorbed_in_body)
            in_bodies.add(body);
        ExactSum both = at_faces;
        both.add(in_bodies);
        CHECK(both == tally.absorbed); // bulk and surface apart, nothing twice
        CHECK(traced.watts(in_bodies) > 0.0);
        CHECK(traced.watts(at_faces) > 0.0);
        CHECK(tally.absorbed_in_body[1] == in_bodies); // of the box alone
    }
}

TEST_CASE("what is absorbed is counted for the body that it is absorbed in, also where no event parts two of "
          "them") {
    for (int pieces : {1, 2, 5}) {
        Lab lab;
        MediumId const smoke = lab.medium(1.5, 1.0); // 1/m
        for (int k = 0; k < pieces; ++k)
            lab.body("piece " + std::to_string(k), Box{{1.0, 1.0, 0.5}}, smoke, moved({0.0, 0.0, 0.5 * k}));
        lab.detector("screen", facing({0.0, 0.0, 0.5 * pieces - 0.25}, {0.0, 0.0, -1.0}), {1.0, 1.0});
        lab.rays({{{0.1, 0.2, -0.25}, {0.0, 0.0, 1.0}}});
        Traced const traced = trace(lab);
        REQUIRE(traced.segments().size() == 1);
        for (int k = 0; k < pieces; ++k)
            CHECK(traced.watts(traced.result.tally.absorbed_in_body[static_cast<std::size_t>(k)]) ==
                  Approx(std::exp(-0.5 * k) - std::exp(-0.5 * (k + 1))).epsilon(1e-13));
        CHECK(traced.watts(traced.result.tally.detected) == std::exp(-0.5 * pieces));
        CHECK(std::abs(traced.result.tally.remainder()) < 1e-16);
    }
}

TEST_CASE("the result does not depend on how rays are grouped, nor on the log") {
    Lab const lab = crowded(1000);
    Traced const whole = trace(lab);
    TraceContext const context{
        whole.scene, whole.optics, whole.emission, lab.experiment.trace, whole.result.tally.unit, 1};
    for (std::uint64_t group : {1, 7, 128, 129, 999}) {
        Tally tally(context.unit, whole.scene.bodies.size(), whole.scene.faces.size(),
                    whole.optics.wavelengths().size());
        std::vector<Segment> log;
        std::size_t hits = 0;
        for (std::uint64_t first = 0; first < 1000; first += group) {
            BatchResult const part =
                trace_batch(context, first, std::min<std::uint64_t>(group, 1000 - first));
            tally.add(part.tally);
            log.insert(log.end(), part.log.segments.begin(), part.log.segments.end());
            for (DetectorHit const& hit : part.hits)
                hits += hit.ray == whole.result.hits[hits].ray && hit.at == whole.result.hits[hits].at &&
                        hit.power == whole.result.hits[hits].power;
        }
        CAPTURE(group);
        CHECK(hits == whole.result.hits.size());
        CHECK(tally.escaped == whole.result.tally.escaped);
        CHECK(tally.absorbed == whole.result.tally.absorbed);
        CHECK(tally.ended == whole.result.tally.ended);
        CHECK(std::equal(log.begin(), log.end(), whole.segments().begin(), whole.segments().end(), same));
    }
    Traced const thin = trace(lab, 7), none = trace(lab, 0);
    CHECK(none.segments().empty());
    CHECK((none.result.tally.ended == whole.result.tally.ended &&
           thin.result.tally.ended == whole.result.tally.ended));
    std::vector<Segment> each_seventh;
    for (Segment const& s : whole.segments())
        if (s.ray % 7 == 0)
            each_seventh.push_back(s);
    CHECK(std::equal(thin.segments().begin(), thin.segments().end(), each_seventh.begin(), each_seventh.end(),
                     same));
}

TEST_CASE("max_depth and min_power cut branches into rows of no length, and count what they carry") {
    for (std::uint32_t max_depth : {0u, 1u, 2u, 10u}) {
        Lab lab;
        lab.body("slab", Box{{1.0, 1.0, 0.1}}, lab.medium(1.5));
        lab.rays({{{0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}}});
        lab.experiment.trace.max_depth = max_depth;
        lab.experiment.trace.min_power = 0.0;
        Traced const traced = trace(lab);
        for (Segment const& s : traced.segments()) {
            CHECK(s.depth <= max_depth + 1);
            CHECK((s.ended == Event::cut_depth) == (s.depth == max_depth + 1));
        }
        // of the light within, 4 % stays at each bounce; the front's reflection escapes unless it is cut
        double const r = 0.04, cut = max_depth == 0 ? 1.0 : (1.0 - r) * std::pow(r, max_depth - 1);
        CHECK(traced.watts(traced.result.tally.cut) == Approx(cut).epsilon(1e-12));
    }
    Lab lab = crowded(200);
    lab.experiment.trace.min_power = 0.01;
    Traced const traced = trace(lab);
    for (Segment const& s : traced.segments()) {
        bool const below = s.power_start < 0.01 / 200.0;
        CHECK((s.ended == Event::cut_power) == below);
    }
}

TEST_CASE("a guard of 65534 interactions ends a ray between perfect mirrors") {
    Lab lab;
    SurfaceId const silver = lab.surface(Shares{1.0, 0.0});
    lab.sheet("one", Plane{}, silver);
    lab.sheet("two", Plane{}, silver, moved({0.0, 0.0, 1.0}));
    lab.rays({{{0.0, 0.0, 0.5}, normalize(dvec3(0.0, 1e-6, 1.0))}});
    lab.experiment.trace.max_depth = 65534;
    Traced const traced = trace(lab);
    CHECK(traced.result.tally.segments() == 65536);
    CHECK(traced.ended(Event::cut_depth) == 1);
    CHECK(traced.watts(traced.result.tally.cut) == 1.0);
}

TEST_CASE("a ray that is no ray is an event, and its power an error") {
    double const nan = std::numeric_limits<double>::quiet_NaN(), inf = INFINITY;
    std::vector<RaySpec> const rays{{{0, 0, 0}, {nan, 0, 1}}, {{nan, 0, 0}, {0, 0, 1}},
                                    {{inf, 0, 0}, {0, 0, 1}}, {{0, 0, 0}, {0, -inf, 1}},
                                    {{0, 0, 0}, {0, 0, 0}},   {{0, 0, -5}, {0, 0, 1}}};
    for (int shapes : {1, 20}) { // alone, and through the tree of boxes
        Lab lab;
        for (int k = 0; k < shapes; ++k)
            lab.body("ball " + std::to_string(k), Sphere{0.1}, lab.medium(1.5),
                     moved({static_cast<double>(k), 0.0, 0.0}));
        lab.rays(rays);
        Traced const traced = trace(lab);
        CHECK(traced.ended(Event::invalid) == 5);
        CHECK(traced.result.lost.size() == 5);
        CHECK(traced.watts(traced.result.tally.error) == Approx(5.0 / 6.0));
        CHECK(std::abs(traced.result.tally.remainder()) < 1e-15);
    }
}

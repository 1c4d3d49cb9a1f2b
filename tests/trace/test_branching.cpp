// Splitting, drawing and dropping branches: each ray's ledger closes under all three, roulette is unbiased,
// and dropped light is counted.
#include "support/catch.h"
#include "support/lab.h"

#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// A slab of index 1.5 in air; half of what meets its back is absorbed by a coating, if asked for.
Lab slab(std::uint64_t rays, bool coated) {
    Lab lab;
    ObjectSpec& body = lab.body("slab", Box{{1.0, 1.0, 0.1}}, lab.medium(1.5, coated ? 1.0 : 0.0));
    if (coated)
        body.faces = {{"front", lab.surface(Shares{0.2, 0.3})}};
    lab.detector("behind", facing({0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}), {1.0, 1.0});
    lab.rays(std::vector<RaySpec>(rays, {{0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}}));
    lab.experiment.trace.min_power = 1e-9;
    return lab;
}

double detected(Lab lab, BranchPolicy policy, double split_until = 0.1, std::uint32_t split_depth = 2) {
    lab.experiment.trace.branch = policy;
    lab.experiment.trace.split_until = split_until;
    lab.experiment.trace.split_depth = split_depth;
    Traced const traced = trace(lab);
    return traced.watts(traced.result.tally.detected);
}

} // namespace

TEST_CASE("every ray's ledger closes by itself, whatever the policy") {
    struct Policy {
        BranchPolicy branch;
        std::uint32_t split_depth;
    };
    for (Policy policy : {Policy{BranchPolicy::split, 2}, Policy{BranchPolicy::roulette, 2},
                          Policy{BranchPolicy::roulette, 0}, Policy{BranchPolicy::dominant, 2}})
        for (bool coated : {false, true}) {
            Lab lab = slab(200, coated);
            lab.experiment.trace.branch = policy.branch;
            lab.experiment.trace.split_until = 2.0; // with roulette: draw from interaction split_depth on
            lab.experiment.trace.split_depth = policy.split_depth;
            Scene const scene = build_scene(lab.experiment);
            WavelengthTable const optics(scene);
            Emission const emission(scene.sources, optics, 1);
            SumUnit const unit = SumUnit::for_total(1.0);
            for (std::uint64_t ray = 0; ray < 200; ++ray) {
                BatchResult const result =
                    trace_batch({scene, optics, emission, lab.experiment.trace, unit, 0}, ray, 1);
                CHECK(std::abs(result.tally.remainder()) < 1e-17); // a ray has 5 mW
                CHECK(result.tally.emitted.value(unit) == Approx(1.0 / 200));
            }
        }
}

TEST_CASE("roulette draws one branch below the share, and splits above it or while the path is short") {
    Lab lab = slab(100, false);
    lab.experiment.trace.branch = BranchPolicy::roulette;
    for (std::uint32_t split_depth : {0u, 2u, 5u})
        for (double split_until : {0.0, 0.03, 2.0}) {
            lab.experiment.trace.split_until = split_until;
            lab.experiment.trace.split_depth = split_depth;
            Traced const traced = trace(lab);
            std::vector<int> children(traced.segments().size(), 0);
            std::vector<std::size_t> parent(traced.segments().size(), 0);
            std::size_t first = 0; // of the ray's segments
            int wrong = 0;
            for (std::size_t i = 0; i < traced.segments().size(); ++i) {
                Segment const& s = traced.segments()[i];
                if (s.index == 0)
                    first = i;
                else
                    ++children[parent[i] = first + static_cast<std::size_t>(s.parent)];
            }
            for (std::size_t i = 0; i < traced.segments().size(); ++i) {
                Segment const& s = traced.segments()[i];
                if (s.ended != Event::refracted)
                    continue;
                bool const splits = s.depth < split_depth || s.power_end > split_until * 0.01;
                wrong += children[i] != (splits ? 2 : 1);
            }
            CAPTURE(split_until, split_depth);
            CHECK(wrong == 0);
            if (split_until == 2.0) // a drawn branch carries all
                for (std::size_t i = 0; i < traced.segments().size(); ++i)
                    if (Segment const& s = traced.segments()[i]; s.depth > split_depth)
                        CHECK(std::abs(s.power_start - traced.segments()[parent[i]].power_end) < 1e-17);
        }
}

TEST_CASE("roulette is unbiased, and its answer depends on the seed") {
    // what comes through a slab without absorption: (1 − R)/(1 + R), R = 0.04; the draws change 0.15 % of it
    double const exact = 0.96 / 1.04;
    CHECK(detected(slab(1, false), BranchPolicy::split) == Approx(exact).epsilon(1e-9));
    double const drawn = detected(slab(20'000, false), BranchPolicy::roulette, 2.0);
    // a branch of 0.96 · 0.04 is drawn into front or back: σ² per ray < 0.0384² · 0.04
    CHECK(std::abs(drawn - exact) < 4.0 * 0.0384 * 0.2 / std::sqrt(20'000.0));
    CHECK(drawn != exact);
    Lab other = slab(20'000, false);
    other.experiment.trace.seed = 2;
    CHECK(detected(other, BranchPolicy::roulette, 2.0) != drawn);
    double const coated = detected(slab(1, true), BranchPolicy::split);
    CHECK(detected(slab(20'000, true), BranchPolicy::roulette, 2.0) == Approx(coated).epsilon(0.01));
    // one branch at each surface: a ray is behind the slab whole, or not at all
    double const alone = detected(slab(20'000, false), BranchPolicy::roulette, 2.0, 0);
    CHECK(std::abs(alone - exact) < 4.0 * std::sqrt(exact * (1.0 - exact) / 20'000.0));
    CHECK(alone != exact);
    CHECK(std::abs(alone * 20'000.0 - std::round(alone * 20'000.0)) < 1e-6);
}

TEST_CASE("dominant follows the strongest branch alone and counts the other as cut") {
    Lab lab = slab(1, false);
    lab.experiment.trace.branch = BranchPolicy::dominant;
    Traced const traced = trace(lab);
    CHECK(traced.watts(traced.result.tally.detected) == Approx(0.96 * 0.96));
    CHECK(traced.watts(traced.result.tally.cut) == Approx(0.04 + 0.96 * 0.04));
    CHECK(traced.ended(Event::cut_power) == 2);
    CHECK(traced.ended(Event::refracted) == 2);
    CHECK(std::abs(traced.result.tally.remainder()) < 1e-15);
}

TEST_CASE("splitting finds the whole series of reflections within a slab") {
    Lab lab = slab(1, false);
    lab.experiment.trace.min_power = 0.0;
    Traced const traced = trace(lab);
    CHECK(traced.watts(traced.result.tally.detected) == Approx(0.96 / 1.04).epsilon(1e-14));
    CHECK(traced.watts(traced.result.tally.escaped) == Approx(2.0 * 0.04 / 1.04).epsilon(1e-14));
}

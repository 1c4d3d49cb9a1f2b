// The law: what a source emits is detected, absorbed, cut or lost, or it escapes; for each ray by itself,
// whichever branches are followed.
#include "support/bench.h"
#include "support/catch.h"
#include "support/ledger.h"

#include <array>
#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// All that can happen to light: a lens that absorbs, a metal, a beam splitter, a white wall, both kinds of
/// detector.
char const* const everything = R"(
[medium]
smoke = {n = 1.5, absorption_per_mm = 0.02}
[surface]
half = {reflect = 0.4, transmit = 0.5}
silver = {n = 0.05, k = 3.5}
white = {diffuse = 0.9}
black = {absorb = true}
[[object]]
name = "lens"
shape = {lens = {r1_mm = 30, r2_mm = -30, thickness_mm = 8, diameter_mm = 20}}
medium = "smoke"
faces = {edge = "black"}
[[object]]
name = "ball"
shape = {sphere = {radius_mm = 5}}
medium = "smoke"
move_mm = [0, 3, 20]
[[object]]
name = "splitter"
shape = {rectangle = {size_mm = [30, 30]}}
surface = "half"
turn_deg = [45, 0, 0]
move_mm = [0, 0, 40]
[[object]]
name = "mirror"
shape = {disk = {radius_mm = 10}}
surface = "silver"
move_mm = [0, 0, 60]
[[object]]
name = "wall"
shape = {rectangle = {size_mm = [40, 40]}}
surface = "white"
turn_deg = [90, 0, 0]
move_mm = [0, -30, 40]
[[detector]]
name = "window"
at_mm = [0, 0, 30]
facing = [0, 0, -1]
size_mm = [20, 20]
absorbs = false
[[detector]]
name = "ceiling"
at_mm = [0, 25, 40]
facing = [0, -1, 0]
size_mm = [40, 40]
[[source]]
name = "beam"
beam = {from_mm = [0, 0, -20], toward = [0, 0.02, 1], radius_mm = 8, pattern = "sobol", rays = 300}
)";

} // namespace

TEST_CASE("the ledger of each ray closes, whichever branches are followed") {
    for (std::string const branch : {"split", "roulette", "dominant"}) {
        CAPTURE(branch);
        Run const run =
            bench::run(everything, {"trace.branch=" + branch, "trace.min_power=1e-4", "trace.max_depth=40"});
        double worst = 0.0;
        for (std::uint64_t ray = 0; ray < 300; ++ray) {
            Rows const rows = rows_of(run, ray);
            REQUIRE(rows.front().parent == -1);
            // Absorbed as the log shows it is what is missing at an interaction, so this sum closes by
            // itself; what must be true is that nothing goes missing where nothing absorbs, nor comes from
            // nothing.
            double missing = 0.0;
            for (Segment const& row : rows) {
                double leaves = 0.0, children = 0.0;
                for (Segment const& child : rows)
                    if (child.parent == static_cast<std::int32_t>(row.index)) {
                        leaves += child.power_start;
                        children += 1.0;
                    }
                std::string const met = surface_at_end(run, row);
                bool const clean =
                    met == "lens.front" || met == "lens.back" || met == "ball" || met == "window";
                if (clean && children > 0.0)
                    missing += std::abs(row.power_end - leaves);
                CHECK(leaves <= row.power_end * (1.0 + 1e-15));
                CHECK(row.power_end <= row.power_start);
            }
            worst = std::max(worst, missing / rows.front().power_start);
        }
        // R and T are found apart and add up to 1 within 2e-15; some ten interactions carry most of the power
        CHECK(worst < 2e-14);

        // the tracer's own sums: every term found for itself
        double const emitted = number_at(run.summary, {"energy_W", "emitted"});
        CHECK(std::abs(number_at(run.summary, {"energy_W", "remainder"})) < 1e-14 * emitted);
        Ledger const ledger = ledger_of(run.segments);
        CHECK(std::abs(static_cast<double>(ledger.remainder())) < 1e-15 * emitted);
        CHECK(std::abs(static_cast<double>(ledger.absorbed) -
                       number_at(run.summary, {"energy_W", "absorbed"})) < 1e-14 * emitted);
        if (branch == "split") // the scene has what it is here for
            for (char const* event : {"refracted", "reflected", "total_internal", "absorbed", "detected",
                                      "escaped", "cut_power", "passed", "scattered"}) {
                CAPTURE(event);
                CHECK(number_at(run.summary, {"events", event}) > 0.0);
            }
    }
}

// Four beam splitters in a row between two detectors: all that varies is the choice of branches. The truth is
// that of adding surfaces one by one, all reflections between them summed: R ← R + T² r/(1 − R r), T ← T t/(1
// − R r). Splitting must find it to within the power that was cut; the mean over 200 seeds must lie within
// four of its standard errors of it. By chance one figure in 16 000 is farther off; the seeds are fixed. The
// standard error must be below half a percent, or the test would show little.
// Constant shares treat s and p alike: no run need look for a difference.
TEST_CASE("roulette is unbiased", "[slow]") {
    double const r = 0.4, t = 0.5;
    int const splitters = 4;
    std::string row =
        text("[surface]\nhalf = {reflect = ", r, ", transmit = ", t, "}\n[[source]]\nname = 'laser'\n",
             "beam = {from_mm = [0, 0, -1], toward = [0, 0, 1], radius_mm = 0.1, rays = 1000}\n",
             "[[detector]]\nname = 'near'\nat_mm = [0, 0, -2]\nfacing = [0, 0, 1]\nsize_mm = [1, 1]\n",
             "[[detector]]\nname = 'far'\nat_mm = [0, 0, 5]\nfacing = [0, 0, -1]\nsize_mm = [1, 1]\n");
    double reflected = 0.0, transmitted = 1.0;
    for (int i = 0; i < splitters; ++i) {
        row += text("[[object]]\nname = 'splitter ", i,
                    "'\nsurface = 'half'\nshape = {disk = {radius_mm = 1}}\n", "move_mm = [0, 0, ", i, "]\n");
        double const between = 1.0 - reflected * r;
        reflected += transmitted * transmitted * r / between;
        transmitted *= t / between;
    }
    std::array<double, 3> const expected{reflected, transmitted, 1.0 - reflected - transmitted};
    auto const figures = [](Value const& summary) {
        return std::array{number_at(summary, {"detectors", "near", "power_W"}),
                          number_at(summary, {"detectors", "far", "power_W"}),
                          number_at(summary, {"energy_W", "absorbed"})};
    };
    Value const split = summarise(row, {"source.laser.beam.rays=1", "trace.min_power=1e-4"});
    double const cut = number_at(split, {"energy_W", "cut"});
    CHECK(cut < 0.05);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(figures(split)[i] < expected[i]);
        CHECK(figures(split)[i] > expected[i] - cut);
    }

    int const seeds = 200;
    std::array<double, 3> sums{}, squares{};
    for (int seed = 1; seed <= seeds; ++seed) {
        auto const found =
            figures(summarise(row, {"trace.branch=roulette", "trace.split_until=1", "trace.min_power=1e-9",
                                    "trace.polarised=false", text("trace.seed=", seed)}));
        for (std::size_t i = 0; i < 3; ++i) {
            sums[i] += found[i];
            squares[i] += found[i] * found[i];
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        double const mean = sums[i] / seeds;
        double const error = std::sqrt((squares[i] / seeds - mean * mean) / (seeds - 1));
        CAPTURE(i, mean, expected[i], error);
        CHECK(error > 0.0);
        CHECK(error < 0.005 * expected[i]);
        CHECK(std::abs(mean - expected[i]) < 4.0 * error);
    }
}

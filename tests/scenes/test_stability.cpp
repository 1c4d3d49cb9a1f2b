// The experiments of experiments/stability: counts of events that are known exactly.
#include "support/bench.h"
#include "support/catch.h"

#include <cmath>

using namespace sahl;
using namespace sahl::bench;
namespace fs = std::filesystem;

namespace {

Value summary_of(std::string const& name, std::vector<std::string> const& set = {}) {
    fs::path const file = fs::path(SAHL_SOURCE_DIR) / "experiments" / "stability" / (name + ".toml");
    RunResult const result = run_experiment(load_experiment(file, set), {});
    CHECK(result.failures == std::vector<std::string>{});
    return result.summary;
}

double events(Value const& summary, std::string_view name) {
    return number_at(summary, {"events", name});
}

/// Walls that a straight line crosses in the unfolded pipe, a millimetre apart.
double walls_crossed(double start, double slope, double length) {
    return std::abs(std::floor(start + slope * length + 0.5));
}

} // namespace

TEST_CASE(
    "stability: two prisms a micrometre apart reflect everything, in contact they transmit everything") {
    Value const apart = summary_of("two-prisms");
    double const rays = number_at(apart, {"rays"});
    CHECK(events(apart, "total_internal") == rays);
    CHECK(number_at(apart, {"detectors", "reflected", "hits"}) == rays);
    CHECK(number_at(apart, {"detectors", "transmitted", "hits"}) == 0.0);
    Value const touching = summary_of("two-prisms", {"object.second.move_mm[1]=-14.142135623730951"});
    CHECK(events(touching, "total_internal") == 0.0);
    CHECK(events(touching, "refracted") == 2.0 * rays); // in and out, nothing between
    CHECK(number_at(touching, {"detectors", "transmitted", "hits"}) == rays);
}

TEST_CASE("stability: light that is reflected ten thousand times in a pipe comes out at its end") {
    Value const pipe = summary_of("light-pipe");
    double expected = 0.0;
    for (auto const& [x, y, by_x, by_y] :
         {std::array{0.123, 0.234, 0.5, 0.4}, std::array{0.1, -0.2, 0.618, 0.2},
          std::array{-0.3, 0.31, 0.3, -0.55}})
        expected += walls_crossed(x, by_x, 11999.9) + walls_crossed(y, by_y, 11999.9);
    CHECK(expected == 30'816.0);
    CHECK(events(pipe, "total_internal") == expected);
    CHECK(number_at(pipe, {"detectors", "far end", "hits"}) == 3.0);
    CHECK(events(pipe, "leak") == 0.0);
}

TEST_CASE("stability: light in a whispering gallery never gets out") {
    Value const gallery = summary_of("whispering-gallery");
    CHECK(events(gallery, "total_internal") == 3.0 * 10'001.0);
    CHECK(events(gallery, "cut_depth") == 3.0);
    CHECK(number_at(gallery, {"energy_W", "escaped"}) == 0.0);
}

TEST_CASE("stability: a shell of a micrometre is crossed twice by every ray, four surfaces") {
    Value const shell = summary_of("shell");
    CHECK(events(shell, "refracted") == 4.0 * number_at(shell, {"rays"}));
    CHECK(events(shell, "escaped") == number_at(shell, {"rays"}));
}

TEST_CASE("stability: water that fits its glass touches it everywhere") {
    // oil, glass, water, glass, oil across; oil, glass, water, air, oil upwards: four surfaces either way
    Value const tumbler = summary_of("tumbler");
    CHECK(events(tumbler, "refracted") == 4.0 * number_at(tumbler, {"rays"}));
    CHECK(events(tumbler, "escaped") == number_at(tumbler, {"rays"}));
}

TEST_CASE("stability: two meshes on each other with different diagonals are one boundary") {
    Value const blocks = summary_of("block-on-block");
    CHECK(events(blocks, "refracted") == 3.0 * number_at(blocks, {"rays"}));
    CHECK(events(blocks, "escaped") == number_at(blocks, {"rays"}));
    CHECK(events(blocks, "leak") == 0.0);
}

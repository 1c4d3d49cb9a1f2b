// A log that is thinned has the rows that were asked for, as they stand in the whole one; nothing else
// changes.
#include "support/bench.h"
#include "support/catch.h"

#include <algorithm>
#include <map>

using namespace sahl;

namespace {

char const* const ball = R"(
trace = {min_power = 1e-5}
object = [{name = "ball", shape = {sphere = {radius_mm = 5}}, medium = "N-BK7"}]
source = [{name = "beam", beam = {from_mm = [0, 0, -10], toward = [0, 0, 1], radius_mm = 4.5, pattern = "random", rays = 500}, lines = ["F", "d"]}]
)";

bool same_row(Segment const& a, Segment const& b) {
    return a.ray == b.ray && a.index == b.index && a.parent == b.parent && a.origin == b.origin &&
           a.direction == b.direction && a.power_start == b.power_start && a.power_end == b.power_end;
}

void check_rows(std::vector<std::string> const& set, auto&& is_asked_for) {
    bench::Run const whole = bench::run(ball), thin = bench::run(ball, set);
    std::map<std::uint64_t, double> power; // of each ray
    for (Segment const& s : whole.segments)
        if (s.parent < 0)
            power[s.ray] = s.power_start;
    std::vector<Segment> expected;
    std::copy_if(whole.segments.begin(), whole.segments.end(), std::back_inserter(expected),
                 [&](Segment const& s) { return is_asked_for(s, s.power_start / power[s.ray]); });
    CHECK(expected.size() > 500);
    CHECK(expected.size() < 0.9 * static_cast<double>(whole.segments.size()));
    CHECK(std::equal(expected.begin(), expected.end(), thin.segments.begin(), thin.segments.end(), same_row));
    CHECK(bench::number_at(whole.summary, {"segments"}) == bench::number_at(thin.summary, {"segments"}));
}

} // namespace

TEST_CASE("a log of each third ray has these, whole", "[record]") {
    check_rows({"log.every=3"}, [](Segment const& s, double) { return s.ray % 3 == 0; });
}

TEST_CASE("a log with a floor has the pieces that begin above it, under the numbers they have", "[record]") {
    check_rows({"log.min_power=0.01"}, [](Segment const&, double share) { return share >= 0.01; });
}

TEST_CASE("each third ray and a floor thin the log together, and the log says so", "[record]") {
    std::vector<std::string> const set{"log.every=3", "log.min_power=0.01"};
    check_rows(set, [](Segment const& s, double share) { return s.ray % 3 == 0 && share >= 0.01; });
    bench::Run const run = bench::run(ball, set);
    CHECK(run.names.every == 3);
    CHECK(run.names.min_power == 0.01);
    CHECK(bench::number_at(run.summary, {"options", "log_min_power"}) == 0.01);
}

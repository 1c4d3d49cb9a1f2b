// Bodies within bodies: too many of them, as many as there may be, and one that nobody can see.
#include "support/catch.h"
#include "support/lab.h"

using namespace sahl;
using namespace sahl::bench;

TEST_CASE("a body in surroundings of its own medium is not seen") {
    Lab lab;
    lab.body("ghost", Sphere{0.5}, {0});
    lab.rays({{{0.1, 0.0, -1.0}, {0.0, 0.0, 1.0}}});
    Traced const traced = trace(lab);
    REQUIRE(traced.segments().size() == 1);
    CHECK(traced.segments()[0].ended == Event::escaped);
}

TEST_CASE("sixteen shells round one place are too many: an invalid ray, not a crash") {
    for (int count : {15, 16, 20}) {
        Lab lab;
        for (int k = 0; k < count; ++k)
            lab.body("shell " + std::to_string(k), Sphere{1.0 - 0.01 * k}, lab.medium(1.5 + 0.01 * k));
        lab.experiment.trace.min_power = 0.5;
        lab.rays({{{0.0, 0.0, -2.0}, {0.0, 0.0, 1.0}}, {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}});
        Traced const traced = trace(lab);
        CHECK(traced.ended(Event::invalid) == (count > 15 ? 2 : 0));
        CHECK(traced.watts(traced.result.tally.error) == Approx(count > 15 ? 1.0 : 0.0).margin(0.5));
        CHECK(std::abs(traced.result.tally.remainder()) < 1e-14);
    }
}

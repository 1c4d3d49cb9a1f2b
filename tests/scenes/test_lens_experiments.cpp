// In: the experiments with stigmatic surfaces and with a colour-corrected lens. Out: that they image as their
// pages say.
#include "support/catch.h"
#include "support/experiments.h"
#include "support/textbook.h"

#include <cmath>

using namespace sahl;
using namespace sahl::bench;

TEST_CASE("the aplanatic ball experiment shows its lamp in one point, under the sine condition") {
    Run const run = run_of("aplanatic-ball", {});
    double const n = 1.5168, R = 10.0;
    dvec3 const image(0.0, 0.0, -n * R);
    std::size_t rays = 0;
    for (std::uint64_t ray = 0; ray < run.names.source_first_ray[1]; ++ray, ++rays) {
        Rows const rows = rows_of(run, ray);
        Segment const out = branch(rows, {Event::refracted});
        CHECK(length(cross(image - 1e3 * out.origin, out.direction)) < 1e-11); // mm
        double const sine = std::hypot(rows.front().direction.x, rows.front().direction.y);
        CHECK(std::abs(n * std::hypot(out.direction.x, out.direction.y) - sine) < 1e-14);
    }
    CHECK(rows_of(run, 0).front().origin.z == -6.5928270042194093e-3);
    CHECK(rays == 2000);
}

TEST_CASE("the aplanatic ball experiment's single rays leave as the closed form says") {
    struct Expected {
        double angle_deg, across, along;
    };
    Expected const expected[] = {{10.0, 0.11448323949560281, 0.99342517980701116},
                                 {45.0, 0.46618326818733355, 0.88468817131358586},
                                 {80.0, 0.64926671480235236, 0.76056080167844625}};
    std::string rays;
    for (Expected const& ray : expected)
        rays += text("[0, 0, -6.5928270042194093, 0, ", std::sin(radians(ray.angle_deg)), ", ",
                     std::cos(radians(ray.angle_deg)), "], ");
    Run const run = run_of("aplanatic-ball", {"source.fan.rays=[" + rays + "]"});
    for (std::size_t i = 0; i < 3; ++i) {
        Segment const out = branch(rows_of(run, run.names.source_first_ray[1] + i), {Event::refracted});
        CHECK(std::abs(out.direction.y - expected[i].across) < 1e-14);
        CHECK(std::abs(out.direction.z - expected[i].along) < 1e-14);
    }
    // the last one on the screen
    Segment const edge = branch(rows_of(run, run.names.source_first_ray[1] + 2), {Event::refracted});
    CHECK(std::abs(1e3 * end_of(edge).y - 34.290151875598523) < 1e-11);
}

// The laws of where light goes: Snell's, reciprocity, equal optical path.
#include "support/bench.h"
#include "support/catch.h"
#include "support/textbook.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

char const* const ball = "[medium]\nglass = {n = 1.5168}\n[[object]]\nname = 'ball'\nmedium = 'glass'\n"
                         "shape = {sphere = {radius_mm = 5}}\nmove_mm = [3, -2, 7]\n";

std::string ray_text(dvec3 const& from_m, dvec3 const& toward) {
    dvec3 const mm = 1e3 * from_m;
    return text("[[source]]\nname = 'ray'\nrays = [[", mm.x, ", ", mm.y, ", ", mm.z, ", ", toward.x, ", ",
                toward.y, ", ", toward.z, "]]\n");
}

} // namespace

// The normal of a sphere is known apart from the tracer. Directions are stored to 1.1e-16 a coordinate,
// places to 1e-16 of the radius: a few times that is left of the difference.
TEST_CASE("every boundary in a log obeys Snell's law and the law of reflection") {
    Run const run = bench::run(std::string(ball) +
                                   "[[source]]\nname = 'beam'\nbeam = {from_mm = [3, -2, -10], "
                                   "toward = [0.05, 0.1, 1], radius_mm = 5, pattern = 'sobol', rays = 400}\n",
                               {"trace.min_power=1e-5"});
    dvec3 const centre(3e-3, -2e-3, 7e-3);
    std::size_t refracted = 0, reflected = 0;
    double worst = 0.0;
    std::size_t first_of_ray = 0;
    for (std::size_t i = 0; i < run.segments.size(); ++i) {
        Segment const& out = run.segments[i];
        if (out.parent < 0) {
            first_of_ray = i;
            continue;
        }
        if (out.born != Event::refracted && out.born != Event::reflected)
            continue;
        Segment const& in = run.segments[first_of_ray + static_cast<std::size_t>(out.parent)];
        dvec3 const normal = (out.origin - centre) / 5e-3;
        double const n1 = run.names.refractive_index[in.medium], n2 = run.names.refractive_index[out.medium];
        // both laws in one: n d × N is the same before and after, in size and in plane
        worst = std::max(worst, length(n1 * cross(in.direction, normal) - n2 * cross(out.direction, normal)));
        bool const crosses = dot(in.direction, normal) * dot(out.direction, normal) > 0.0;
        CHECK(crosses == (out.born == Event::refracted));
        CHECK((in.medium != out.medium) == crosses);
        ++(crosses ? refracted : reflected);
    }
    CHECK(refracted > 1000);
    CHECK(reflected > 1000);
    CHECK(worst < 4e-15);
}

TEST_CASE("light finds the same way back, and loses the same on it") {
    char const* const optics = R"(
[medium]
glass = {n = 1.5168, absorption_per_mm = 0.01}
flint = {n = 1.7283}
[[object]]
name = "lens"
shape = {lens = {r1_mm = 40, r2_mm = -60, thickness_mm = 12, diameter_mm = 30}}
medium = "glass"
turn_deg = [3, -4, 0]
[[object]]
name = "prism"
shape = {prism = {apex_deg = 40, side_mm = 40, length_mm = 40}}
medium = "flint"
turn_deg = [0, 90, 0]
move_mm = [0, 0, 40]
)";
    for (dvec3 const& start_mm : {dvec3(1, 2, -20), dvec3(-6, 3, -20), dvec3(7, -5, -20)}) {
        Rows const there = direct_path(
            rows_of(bench::run(optics + ray_text(1e-3 * start_mm, normalize(dvec3(0.05, -0.08, 1)))), 0));
        REQUIRE(there.size() == 5);
        Segment const& last = there.back();
        Rows const back = direct_path(
            rows_of(bench::run(optics + ray_text(last.origin + 0.03 * last.direction, -last.direction)), 0));
        REQUIRE(back.size() == 5);
        for (std::size_t i = 0; i < 4; ++i) {
            // places of 50 mm and their writing in 17 digits round to 1e-17 m, some ten times over four
            // surfaces
            CHECK(length(end_of(back[i]) - end_of(there[3 - i])) < 1e-15);
            CHECK(length(back[i].direction + there[4 - i].direction) < 1e-14);
        }
        CHECK(length(back[4].direction + there[0].direction) < 1e-14);
        double const forth = there[4].power_start / there[0].power_start;
        CHECK(std::abs(back[4].power_start / back[0].power_start - forth) < 1e-14);
        CHECK(forth < 0.99);
    }
}

// Weierstrass: from the point R/n off a ball's centre all rays of the hemisphere around the centre's
// direction leave as if they came from nR off it, at the angle of refraction that they started with; the
// optical path to the surface is the distance from there: n·|OP| = |IP| for every P on the sphere.
TEST_CASE("optical paths between conjugate points are equal") {
    double const n = 1.5168, radius_mm = 10.0;
    Run const run =
        bench::run(text("[medium]\nglass = {n = ", n, "}\n[[object]]\nname = 'ball'\nmedium = 'glass'\n",
                        "shape = {sphere = {radius_mm = ", radius_mm,
                        "}}\n[[source]]\nname = 'lamp'\npoint = {at_mm = ", dvec3(0.0, 0.0, -radius_mm / n),
                        ", toward = [0, 0, 1], half_angle_deg = 85, rays = 500}\n"),
                   {"trace.min_power=1e-3"});
    dvec3 const image(0.0, 0.0, -1e-3 * n * radius_mm);
    std::size_t rays = 0;
    for (std::uint64_t ray = 0; ray < 500; ++ray) {
        Rows const rows = rows_of(run, ray);
        if (rows.front().ended != Event::refracted)
            continue;
        Segment const& out = branch(rows, {Event::refracted});
        dvec3 const from_image = out.origin - image;
        // 25 mm at most, each stored to 3.5e-18 m
        CHECK(std::abs(rows.front().optical_path - length(from_image)) < 1e-16);
        CHECK(length(cross(normalize(from_image), out.direction)) < 1e-14);
        ++rays;
    }
    CHECK(rays == 500); // the angle of incidence's sine is at most 1/n: none is reflected totally
}

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

namespace {

/// Where the ray at a height that goes straight through crosses the axis, mm from the lenses' last vertex.
double crossing_mm(std::string const& lens, double axis_mm, double height_mm, std::size_t line) {
    std::string const beam = "source.light for the " + lens + ".beam.";
    Run const run = run_of("achromat", {beam + "from_mm=" + text(dvec3(0.0, axis_mm + height_mm, -10.0)),
                                        beam + "radius_mm=0", beam + "rays=1"});
    std::uint64_t const first = run.names.source_first_ray[lens == "doublet" ? 0 : 1];
    Segment const last = direct_path(rows_of(run, first + line)).back();
    REQUIRE(last.ended == Event::detected);
    return 1e3 * last.origin.z - (1e3 * last.origin.y - axis_mm) * last.direction.z / last.direction.y - 8.5;
}

} // namespace

TEST_CASE("the achromat experiment brings F, d and C together where an exact trace does") {
    struct Lens {
        char const* name;
        double axis_mm, at_5_mm[3], at_10_mm[3]; // F, d, C
    };
    Lens const lenses[] = {{"doublet",
                            0.0,
                            {95.925714240855922415, 95.920109389380102534, 95.988375405196914147},
                            {95.945005055685782353, 95.880729041258453431, 95.927077986630648338}},
                           {"single lens",
                            -40.0,
                            {94.721806895572562522, 95.772251291593998082, 96.24635459791405752},
                            {93.904135622428977568, 94.946950116510991256, 95.417566591495839376}}};
    for (Lens const& lens : lenses)
        for (std::size_t line = 0; line < 3; ++line) {
            CAPTURE(lens.name, line);
            // the axis is met at 1/20 or more: a direction's rounding, 1e-16, and those of places of 100 mm,
            // 1.4e-14 mm, grow twentyfold
            CHECK(std::abs(crossing_mm(lens.name, lens.axis_mm, 5.0, line) - lens.at_5_mm[line]) < 2e-12);
            CHECK(std::abs(crossing_mm(lens.name, lens.axis_mm, 10.0, line) - lens.at_10_mm[line]) < 2e-12);
        }
}

TEST_CASE("the oval experiment images a point by one path, and parallel light into the glass") {
    Run const run = run_of("cartesian-oval", {});
    double const n = 1.5168;
    struct Image {
        std::uint64_t source;
        dvec3 at_mm;
        std::size_t surfaces;
        double path_mm;
    };
    // a + n b less the glass that is missing before the image; 10 mm and n f
    for (Image const& image : {Image{0, {0, 0, 150}, 2, 200.0 + n * 150.0 - (n - 1.0) * 138.0},
                               Image{1, {0, -40, 50}, 1, 10.0 + n * 50.0}}) {
        std::size_t rays = 0;
        std::uint64_t const first = run.names.source_first_ray[image.source];
        for (std::uint64_t ray = first; ray < run.names.source_first_ray[image.source + 1]; ++ray, ++rays) {
            Segment const last =
                branch(rows_of(run, ray), std::vector<Event>(image.surfaces, Event::refracted));
            REQUIRE(last.ended == Event::detected);
            dvec3 const to_image = normalize(image.at_mm - 1e3 * last.origin);
            CHECK(length(cross(to_image, last.direction)) <= 1e-13); // rad
            // some ten roundings of 400 mm, 6e-14 mm
            CHECK(std::abs(1e3 * last.optical_path - image.path_mm) < 5e-13);
        }
        CHECK(rays >= 500);
    }
}

TEST_CASE("the oval experiment's ellipsoid bends the rays of the bank as it says") {
    struct Expected {
        double height_mm, hit_z_mm, direction;
    };
    for (Expected const& ray : {Expected{1.0, 0.029364152423527415, -0.020007746710496550},
                                Expected{10.0, 3.0938049003063733, -0.20850575042740456}}) {
        Run const run = run_of("cartesian-oval",
                               {"source.beam.beam.from_mm=" + text(dvec3(0.0, ray.height_mm - 40.0, -10.0)),
                                "source.beam.beam.radius_mm=0", "source.beam.beam.rays=1"});
        Segment const in = branch(rows_of(run, run.names.source_first_ray[1]), {Event::refracted});
        CHECK(std::abs(1e3 * in.origin.z - ray.hit_z_mm) < 1e-13);
        CHECK(std::abs(in.direction.y - ray.direction) < 1e-14);
    }
}

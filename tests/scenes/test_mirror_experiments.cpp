// In: the experiments mirror-caustic and cassegrain. Out: that mirrors of conics focus as the definitions of
// parabola and hyperbola say, and that a sphere's rays touch Cayley's caustic.
#include "support/catch.h"
#include "support/experiments.h"
#include "support/textbook.h"

#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// Settings that make one ray, from there, of a source that is a beam.
std::vector<std::string> single_ray(std::string const& source, dvec3 const& from_mm) {
    std::string const beam = "source." + source + ".beam.";
    return {beam + "from_mm=" + text(from_mm), beam + "radius_mm=0", beam + "rays=1"};
}

/// The sphere's ray at a height, relative to the mirror's axis and centre.
Segment from_sphere(double height_mm) {
    Run const run = run_of("mirror-caustic", single_ray("left beam", {height_mm - 80.0, 0.0, 0.0}));
    for (Segment row : rows_of(run, 0))
        if (row.born == Event::reflected) {
            row.origin.x += 0.08;
            return row;
        }
    FAIL("no ray is reflected");
    return {};
}

struct Line {
    double x, z, slope; // x = … + slope (Z − z)
};

Line line_of(Segment const& segment) {
    return {1e3 * segment.origin.x, 1e3 * segment.origin.z, segment.direction.x / segment.direction.z};
}

} // namespace

TEST_CASE("the caustic experiment's sphere spreads its focus along the axis and along a nephroid") {
    struct Height {
        double mm, crossing_mm, caustic_x_mm, caustic_z_mm;
    };
    for (Height const& height :
         {Height{20.0, 51.031036307982877, 0.8, 52.908978444116647}, Height{60.0, 62.5, 21.6, 68.8},
          Height{70.0, 70.014004201400490, 34.3, 70.700141442574215}}) {
        CAPTURE(height.mm);
        Line const line = line_of(from_sphere(height.mm));
        CHECK(std::abs(line.z - line.x / line.slope - height.crossing_mm) < 1e-12);
        // rays 2 µm apart meet on the envelope but for (1 µm)²/R, 1e-8 mm; some 4e-5 rad between them make
        // 1e-9 mm of what places are rounded to
        Line const a = line_of(from_sphere(height.mm - 1e-3)), b = line_of(from_sphere(height.mm + 1e-3));
        double const z = (b.x - a.x + a.slope * a.z - b.slope * b.z) / (a.slope - b.slope);
        CHECK(std::abs(z - height.caustic_z_mm) < 1e-7);
        CHECK(std::abs(a.x + a.slope * (z - a.z) - height.caustic_x_mm) < 1e-7);
    }
}

TEST_CASE("the caustic experiment's paraboloid brings its whole beam to one point") {
    Run const run = run_of("mirror-caustic", {});
    dvec3 const focus(80.0, 0.0, 50.0);
    std::uint64_t const first = run.names.source_first_ray[1];
    std::size_t reflected = 0;
    for (Segment const& row : run.segments)
        if (row.ray >= first && row.born == Event::reflected) {
            CHECK(length(cross(normalize(focus - 1e3 * row.origin), row.direction)) <= 1e-13); // rad
            ++reflected;
        }
    CHECK(reflected == 41);
}

TEST_CASE("the Cassegrain experiment brings a star to one point by one path, y = 2 f tan(U/2)") {
    Run const run = run_of("cassegrain", {});
    double const f = 1200.0;
    dvec3 const focus(0.0, 0.0, 100.0);
    double arrived = 0.0;
    std::size_t rays = 0;
    for (Segment const& last : run.segments) {
        if (last.ended != Event::detected || last.ray >= run.names.source_first_ray[1])
            continue;
        Segment const first = rows_of(run, last.ray).front();
        double const y = 1e3 * std::hypot(first.origin.x, first.origin.y);
        double const across = std::hypot(last.direction.x, last.direction.y);
        CHECK(std::abs(2.0 * f * across / (1.0 + last.direction.z) - y) <= 1e-13 * y); // tan(U/2)
        CHECK(length(cross(normalize(focus - 1e3 * last.origin), last.direction)) <= 1e-13);
        CHECK(std::abs(1e3 * last.optical_path - 970.0) < 1e-12);
        arrived += last.power_end;
        ++rays;
    }
    CHECK(rays > 1200);
    // 1500 rays in a hexagonal pattern: some 60 along either edge, each of 1/1500
    CHECK(std::abs(arrived - 0.8911) < 0.01 * 0.8911);
}

TEST_CASE("the Cassegrain experiment has the coma of a paraboloid of the same focal ratio") {
    double const angle = radians(0.1), f = 1200.0;
    auto const tangential_mm = [&](double y) { // where the rays at ±y meet the focal plane, in the mean
        double sum = 0.0;
        for (double const height : {-y, y}) {
            dvec3 const from(0.0, height + 320.0 * std::tan(angle), -320.0); // at y in the vertex's plane
            Run const run = run_of("cassegrain", single_ray("companion", from));
            Rows const rows = rows_of(run, run.names.source_first_ray[1]);
            REQUIRE(rows.back().ended == Event::detected);
            sum += 0.5e3 * end_of(rows.back()).y;
        }
        return sum;
    };
    double const rim = tangential_mm(99.0), half = tangential_mm(49.5);
    double const ratio = f / 198.0, coma = 3.0 * angle * f / (16.0 * ratio * ratio);
    CHECK(std::abs(std::abs(rim - half) - 0.75 * coma) < 0.01 * coma);
    CHECK(std::abs(std::abs(half) - f * std::tan(angle)) < coma);
}

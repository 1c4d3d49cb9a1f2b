// In: the experiments concentrator, fibre and light-pipe. Out: that they accept the light that étendue, the
// critical angle and the method of images say, and hand it on where they say.
#include "support/catch.h"
#include "support/experiments.h"
#include "support/textbook.h"

#include <cmath>
#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

std::string const no_sweep = "sweep={}";

double power_of(Value const& summary, std::string_view detector, std::string_view source) {
    return number_at(summary, {"detectors", detector, "by_source", source, "power_W"});
}

/// Where a place between walls at ±half is, when the walls are mirrors and it would lie at x without them.
double folded(double x, double half) {
    double const along = std::remainder(x + half, 4.0 * half);
    return std::abs(along) - half; // up and down again in each period of twice the width
}

} // namespace

TEST_CASE("the concentrator experiment takes all light within its acceptance angle and none beyond") {
    Folder const out;
    run_experiment_of("concentrator", out.path() / "out",
                      {"source.sky.lambertian.rays=16", "source.sunlight.beam.rays=500"});
    auto columns = read_sweep(out.path() / "out" / "sweep.csv");
    auto const& angle = columns["group.sun.turn_deg[1]"];
    auto const& in = columns["detectors.entrance.by_source.sunlight.power_W"];
    auto const& through = columns["detectors.exit.by_source.sunlight.power_W"];
    REQUIRE(angle.size() == 42);
    for (std::size_t i = 0; i < angle.size(); ++i) {
        CAPTURE(angle[i]);
        CHECK(in[i] > 0.49); // 40 mm · cos of a beam of 60 mm
        CHECK(through[i] == (std::abs(angle[i]) < 30.0 ? in[i] : 0.0));
    }
}

TEST_CASE("the concentrator experiment sends rays at its acceptance angle to the edge of its exit") {
    Run const run = run_of("concentrator", {no_sweep, "group.sun.turn_deg[1]=30",
                                            "source.sunlight.beam.rays=100", "source.sky.lambertian.rays=1"});
    dvec3 const edge(10.0, 0.0, 0.0); // across the trough from the left wall, which all of them meet
    std::size_t rays = 0;
    for (std::uint64_t ray = 0; ray < run.names.source_first_ray[1]; ++ray) {
        Rows const rows = rows_of(run, ray);
        if (rows.front().ended != Event::passed)
            continue; // it comes down beside the entrance
        Segment const reflected = branch(rows, {Event::passed, Event::reflected});
        dvec3 const miss = cross(edge - 1e3 * reflected.origin, reflected.direction);
        // y runs along the trough; ten roundings of 50 mm, 7e-15 mm
        CHECK(std::abs(miss.y) < 1e-13);
        ++rays;
    }
    CHECK(rays > 50);
}

TEST_CASE("the concentrator experiment takes sin θ of diffuse light, and its exit shines by the cosine law") {
    Run const run = run_of("concentrator", {no_sweep, "source.sky.lambertian.rays=40000"});
    double const share = power_of(run.summary, "exit", "sky") / 1e-6;
    // a share of 0.5 of 40 000 independent rays: four standard errors
    CHECK(std::abs(share - 0.5) < 4.0 * 0.5 / std::sqrt(40000.0));
    double cosine = 0.0, count = 0.0;
    for (std::uint64_t ray = run.names.source_first_ray[1]; ray < run.names.source_first_ray[1] + 40000;
         ++ray) {
        Segment const last = rows_of(run, ray).back();
        if (last.ended == Event::detected) {
            cosine -= last.direction.z;
            count += 1.0;
        }
    }
    // by the cosine law the cosine has the mean 2/3 and the standard deviation √(1/2 − 4/9)
    CHECK(std::abs(cosine / count - 2.0 / 3.0) < 4.0 * std::sqrt(1.0 / 18.0 / count));
}

namespace {

double const core = 1.48, cladding = 1.46;

/// What comes to the end of the fibre of a ray that comes in at the angle, `across` to the plane of the angle
/// and `along` it (radius 1): at the wall it meets the same incidence again and again, once for each chord.
double through_the_fibre(double angle, double across, double along, double length) {
    double const inside = std::asin(std::sin(angle) / core);
    double const half = std::sqrt((1.0 - across) * (1.0 + across));
    double const sine_from_wall = std::sin(inside) * half, run = length * std::tan(inside);
    double const entered = 1.0 - mean_reflectance(1.0, core, angle);
    double const incidence = std::acos(sine_from_wall);
    if (core * std::sin(incidence) >= cladding || run < half - along)
        return entered;
    double const times = std::floor((run - (half - along)) / (2.0 * half)) + 1.0;
    return entered * std::pow(mean_reflectance(core, cladding, incidence), times);
}

} // namespace

TEST_CASE("the fibre experiment carries each ray as its incidence at the wall says, skew rays farther") {
    double const aperture = std::sqrt((core - cladding) * (core + cladding));
    for (double const angle_deg : {5.0, 14.0, 15.0, 20.0}) {
        CAPTURE(angle_deg);
        double const angle = radians(angle_deg);
        Run const run = run_of(
            "fibre", {no_sweep, text("group.lamp.turn_deg[0]=", angle_deg), "source.beam.beam.rays=500"});
        std::size_t guided = 0, rays = 0;
        long double expected = 0.0L;
        std::size_t const all = static_cast<std::size_t>(number_at(run.summary, {"rays"}));
        for (std::uint64_t ray = 0; ray < all; ++ray, ++rays) {
            Segment const first = rows_of(run, ray).front();
            dvec3 const in = 1e3 * end_of(first);
            // turned about +x the beam goes to −y
            expected += through_the_fibre(angle, in.x, -in.y, 200.0) / static_cast<double>(all);
            guided += std::sin(angle) * std::sqrt(1.0 - in.x * in.x) <= aperture ? 1 : 0;
        }
        double const arrived = number_at(run.summary, {"detectors", "end of the core", "power_W"});
        double const cut = number_at(run.summary, {"energy_W", "cut"});
        CHECK(std::abs(arrived - static_cast<double>(expected)) <= cut + 1e-12);
        // the share of the beam's disc, 0.9 of the core's radius, that is far enough from the axis
        double const s = aperture / std::sin(angle);
        double const least = s < 1.0 ? std::sqrt(1.0 - s * s) / 0.9 : 0.0;
        double const share =
            1.0 - 2.0 / std::numbers::pi * (std::asin(least) + least * std::sqrt(1.0 - least * least));
        // 500 points of a low-discrepancy sequence miss a part of a disc by some 1 %
        CHECK(std::abs(static_cast<double>(guided) / static_cast<double>(rays) - share) < 0.01);
    }
}

TEST_CASE("the light pipe experiment hands every ray on as between mirrors unfolded") {
    double const n = 1.49, length_mm = 59.999;
    Run const run = run_of("light-pipe", {"source.lamp.lambertian.rays=1000"});
    std::size_t rays = 0;
    for (std::uint64_t ray = 0; ray <= run.names.source_first_ray[1]; ++ray, ++rays) {
        Rows const path = direct_path(rows_of(run, ray));
        dvec3 const in = 1e3 * end_of(path.front()), d = path.front().direction;
        dvec3 const inside(d.x / n, d.y / n, std::sqrt(1.0 - (d.x * d.x + d.y * d.y) / (n * n)));
        Segment last = path.back();
        for (Segment const& row : rows_of(run, ray)) // the deepest one that is not the entrance's reflection
            if (row.ended == Event::detected)
                last = row;
        REQUIRE(last.ended == Event::detected);
        dvec3 const at = 1e3 * end_of(last);
        // 60 mm at up to 42° in up to 22 pieces, each of whose ends is rounded by 1e-15 mm and more
        CHECK(std::abs(at.x - folded(in.x + length_mm * inside.x / inside.z, 2.5)) < 1e-12);
        CHECK(std::abs(at.y - folded(in.y + length_mm * inside.y / inside.z, 2.5)) < 1e-12);
        CHECK(std::abs(std::abs(last.direction.x) - std::abs(inside.x)) < 2e-15);
        CHECK(std::abs(std::abs(last.direction.y) - std::abs(inside.y)) < 2e-15);
    }
    CHECK(rays == 1001);
}

TEST_CASE("the light pipe experiment takes the whole half space, less what its entrance reflects") {
    Folder const out;
    Value const summary = run_experiment_of("light-pipe", out.path() / "out", {}).summary;
    double entered = 0.0; // of diffuse light: ∫ T(θ) 2 sin θ cos θ dθ
    for (Node const& node : gauss_legendre(60)) {
        double const angle = 0.5 * std::numbers::pi * node.x;
        entered += 0.5 * std::numbers::pi * node.weight * std::sin(2.0 * angle) *
                   (1.0 - mean_reflectance(1.0, 1.49, angle));
    }
    // 20 000 Sobol points of a smooth function but for the grazing end, where it falls to 0
    CHECK(std::abs(power_of(summary, "at the end", "lamp") - entered) < 1e-4);
    // even: each quarter of the end has a quarter of the light, to four standard errors of 20 000 rays
    double const rms = number_at(summary, {"detectors", "at the end", "rms_radius_mm"});
    CHECK(std::abs(rms * rms - 25.0 / 6.0) < 4.0 * std::sqrt(7.0 / 180.0) * 25.0 / std::sqrt(2.0 * 20000.0));
}

// Rays of sources: as many as promised, in order, where and how they should be, with all of the power and no
// more.
#include "math/input_error.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"

#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// A lab with nothing in it but the source that it is asked for.
struct Lamp {
    Scene scene;
    WavelengthTable optics;
    Emission emission;

    explicit Lamp(Lab const& lab, std::uint64_t seed = 1)
        : scene(build_scene(lab.experiment)), optics(scene), emission(scene.sources, optics, seed) {}
    std::vector<Ray> rays() const {
        std::vector<Ray> all;
        for (std::uint64_t number = 0; number < emission.rays(); ++number)
            all.push_back(emission.ray(number));
        return all;
    }
};

Beam beam(Pattern pattern, double radius, dvec2 size, std::uint64_t rays) {
    Beam made;
    made.from = {0.1, 0.2, 0.3};
    made.toward = normalize(dvec3(1.0, 2.0, -0.5));
    made.up = perpendicular_to(made.toward, {0.0, 0.0, 1.0});
    made.radius = radius;
    made.size = size;
    made.pattern = pattern;
    made.rays = rays;
    return made;
}

template <class Emitter>
std::vector<Ray> rays_of(Emitter const& emitter, std::uint64_t seed = 1) {
    Lab lab;
    lab.source(emitter);
    return Lamp(lab, seed).rays();
}

double total(std::vector<Ray> const& rays) {
    ExactSum sum;
    for (Ray const& ray : rays)
        sum.add(ray.power, SumUnit{});
    return sum.value(SumUnit{});
}

constexpr Pattern patterns[] = {Pattern::grid, Pattern::hexagonal, Pattern::random, Pattern::sobol,
                                Pattern::fan,  Pattern::ring,      Pattern::edge};

/// Where a ray starts, across the beam: along its first and its second axis.
dvec2 across(Beam const& b, Ray const& ray) {
    dvec3 const from = ray.origin - b.from;
    return {dot(from, cross(b.up, b.toward)), dot(from, b.up)};
}

} // namespace

TEST_CASE(
    "a beam's rays start within it, on its plane, all along its axis, as many as asked for or some more") {
    for (Pattern pattern : patterns)
        for (bool round : {true, false})
            for (std::uint64_t count : {1, 2, 7, 100, 1000}) {
                Beam const b =
                    beam(pattern, round ? 0.01 : 0.0, round ? dvec2(0.0) : dvec2(0.03, 0.01), count);
                std::vector<Ray> const rays = rays_of(b);
                CAPTURE(static_cast<int>(pattern), round, count, rays.size());
                CHECK(rays.size() >= count);
                CHECK(rays.size() <= count + 200); // an incomplete row, column or shell
                int outside = 0;
                for (Ray const& ray : rays) {
                    dvec2 const at = across(b, ray);
                    outside += round ? length(at) > 0.01 * (1.0 + 1e-12)
                                     : std::abs(at.x) > 0.015 * (1.0 + 1e-12) ||
                                           std::abs(at.y) > 0.005 * (1.0 + 1e-12);
                    outside +=
                        std::abs(dot(ray.origin - b.from, b.toward)) > 1e-15 || ray.direction != b.toward;
                }
                CHECK(outside == 0);
                CHECK(total(rays) == Approx(1.0).epsilon(1e-15));
            }
}

TEST_CASE("a beam's patterns fill it evenly") {
    // the mean of r² over a disk is R²/2, over a rectangle (a² + b²)/12
    for (Pattern pattern : {Pattern::grid, Pattern::hexagonal, Pattern::random, Pattern::sobol})
        for (bool round : {true, false}) {
            Beam const b = beam(pattern, round ? 0.01 : 0.0, round ? dvec2(0.0) : dvec2(0.03, 0.01), 10'000);
            double mean_square = 0.0;
            dvec2 centre(0.0);
            std::vector<Ray> const rays = rays_of(b);
            for (Ray const& ray : rays) {
                mean_square += dot(across(b, ray), across(b, ray)) * ray.power;
                centre += across(b, ray) * ray.power;
            }
            double const expected = round ? 0.5e-4 : (9e-4 + 1e-4) / 12.0;
            CAPTURE(static_cast<int>(pattern), round);
            // 10⁴ random points: the mean of r² to 0.6 % of itself, the centre to 0.5 % of R; four times that
            CHECK(mean_square == Approx(expected).epsilon(0.03));
            CHECK(length(centre) < 0.02 * (round ? 0.01 : 0.015));
        }
}

TEST_CASE("fans and rings lie where they should") {
    Beam const round_fan = beam(Pattern::fan, 0.01, dvec2(0.0), 11),
               flat_fan = beam(Pattern::fan, 0.0, {0.0, 0.04}, 11);
    for (Ray const& ray : rays_of(round_fan))
        CHECK(std::abs(across(round_fan, ray).x) < 1e-16);
    CHECK(across(round_fan, rays_of(round_fan).front()).y == Approx(-0.01));
    CHECK(across(round_fan, rays_of(round_fan).back()).y == Approx(0.01));
    CHECK(across(flat_fan, rays_of(flat_fan).back()).y == Approx(0.02));
    Beam const round_ring = beam(Pattern::ring, 0.01, dvec2(0.0), 12);
    for (Ray const& ray : rays_of(round_ring))
        CHECK(length(across(round_ring, ray)) == Approx(0.01).epsilon(1e-14));
    Beam const line = beam(Pattern::grid, 0.0, {0.0, 0.0}, 5);
    CHECK(rays_of(line).size() == 5);
    for (Ray const& ray : rays_of(line))
        CHECK(ray.origin == line.from);
}

TEST_CASE("a Gaussian beam's rays weigh what the profile says, and add up to the power") {
    for (Pattern pattern : patterns)
        for (bool round : {true, false}) {
            Beam b = beam(pattern, round ? 0.01 : 0.0, round ? dvec2(0.0) : dvec2(0.03, 0.01), 500);
            b.gaussian_radius = 0.004;
            Lab lab;
            SourceSpec& source = lab.source(b);
            source.wavelengths = {{450e-9, 1.0}, {550e-9, 2.0}, {650e-9, 5.0}};
            source.power = 3.0;
            std::vector<Ray> const rays = Lamp(lab).rays();
            CAPTURE(static_cast<int>(pattern), round);
            double colours[3] = {0.0, 0.0, 0.0};
            double wrong = 0.0;
            double const unit =
                std::ldexp(1.0, -89); // W: the ledger's for 3 W, of which powers are whole numbers
            for (Ray const& ray : rays) {
                colours[ray.wavelength.value] += ray.power;
                Ray const& first = rays[ray.wavelength.value * rays.size() / 3]; // of the same colour
                dvec2 const at = across(b, ray), there = across(b, first);
                double const ratio = std::exp(-2.0 * (dot(at, at) - dot(there, there)) / (0.004 * 0.004));
                double const off = std::abs(ray.power - first.power * ratio) - unit * (1.0 + ratio);
                wrong = std::max(wrong, off / first.power / std::max(1.0, ratio));
            }
            CHECK(wrong < 1e-12);
            CHECK(colours[0] == Approx(3.0 / 8.0).epsilon(1e-12));
            CHECK(colours[1] == Approx(6.0 / 8.0).epsilon(1e-12));
            CHECK(colours[2] == Approx(15.0 / 8.0).epsilon(1e-12));
        }
}

TEST_CASE("a profile too narrow for its rays is an error, not a beam of not-a-numbers") {
    Beam b = beam(Pattern::grid, 0.01, dvec2(0.0), 4);
    b.gaussian_radius = 1e-6;
    CHECK_THROWS_AS(rays_of(b), InputError);
}

TEST_CASE("a point source is uniform in solid angle over its cone") {
    for (double half_angle : {1e-3, 0.5, 1.5, std::numbers::pi / 2, 3.0, std::numbers::pi}) {
        PointEmitter emitter{{1, 2, 3}, normalize(dvec3(1, -1, 2)), dvec3(0.0), half_angle, 20'000};
        emitter.up = perpendicular_to(emitter.toward);
        double const lowest = std::cos(half_angle);
        double mean = 0.0, smallest = 1.0;
        dvec3 sum(0.0);
        std::vector<Ray> const rays = rays_of(emitter);
        REQUIRE(rays.size() == 20'000);
        for (Ray const& ray : rays) {
            CHECK(ray.origin == emitter.at);
            CHECK(std::abs(length(ray.direction) - 1.0) < 4e-16);
            double const cosine = dot(ray.direction, emitter.toward);
            mean += cosine / 20'000;
            smallest = std::min(smallest, cosine);
            sum += (ray.direction - cosine * emitter.toward) / 20'000.0;
        }
        CAPTURE(half_angle);
        // uniform in the cosine: its mean is in the middle; Sobol points are far better than the 4σ of random
        // ones
        double const sigma = (1.0 - lowest) / std::sqrt(12.0 * 20'000);
        CHECK(std::abs(mean - 0.5 * (1.0 + lowest)) < 4.0 * sigma);
        CHECK(smallest >= lowest - 1e-15);
        CHECK(smallest < lowest + 0.01 * (1.0 - lowest));
        CHECK(length(sum) < 0.02);
        CHECK(total(rays) == Approx(1.0).epsilon(1e-15));
    }
}

TEST_CASE("a Lambertian source obeys the cosine law and fills its rectangle") {
    LambertianEmitter const emitter{{1, 2, 3}, {0, 0, -1}, {0, 1, 0}, {0.2, 0.1}, 50'000};
    double mean = 0.0, mean_x2 = 0.0, mean_y2 = 0.0;
    for (Ray const& ray : rays_of(emitter)) {
        double const cosine = dot(ray.direction, emitter.toward);
        CHECK((cosine >= 0.0 && std::abs(ray.origin.x - 1.0) <= 0.1 && std::abs(ray.origin.y - 2.0) <= 0.05 &&
               ray.origin.z == 3.0));
        mean += cosine / 50'000;
        mean_x2 += (ray.origin.x - 1.0) * (ray.origin.x - 1.0) / 50'000;
        mean_y2 += (ray.origin.y - 2.0) * (ray.origin.y - 2.0) / 50'000;
    }
    // the cosine of the law has mean 2/3 and variance 1/18
    CHECK(std::abs(mean - 2.0 / 3.0) < 4.0 * std::sqrt(1.0 / 18.0 / 50'000));
    CHECK(mean_x2 == Approx(0.04 / 12.0).epsilon(0.01));
    CHECK(mean_y2 == Approx(0.01 / 12.0).epsilon(0.01));
}

TEST_CASE(
    "ray numbers run through sources, wavelengths and rays in order, and a ray depends on its number alone") {
    Lab lab;
    lab.source(beam(Pattern::ring, 0.01, dvec2(0.0), 3)).wavelengths = {{500e-9, 3.0}, {600e-9, 1.0}};
    lab.rays({{{1, 0, 0}, {0, 0, 1}, 1.0}, {{2, 0, 0}, {0, 0, 1}, 3.0}}).wavelengths = {{600e-9, 1.0},
                                                                                        {700e-9, 1.0}};
    lab.experiment.sources.back().power = 2.0;
    lab.source(beam(Pattern::random, 0.01, dvec2(0.0), 4));
    Lamp const lamp(lab);
    CHECK(lamp.emission.first_rays() == std::vector<std::uint64_t>{0, 6, 10, 14});
    CHECK(lamp.emission.power() == 4.0);
    std::vector<Ray> const rays = lamp.rays();
    REQUIRE(rays.size() == 14);
    std::vector<std::uint32_t> sources, colours;
    for (Ray const& ray : rays) {
        sources.push_back(ray.source.value);
        colours.push_back(ray.wavelength.value);
    }
    CHECK(sources == std::vector<std::uint32_t>{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2});
    CHECK(colours == std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1, 1, 1, 2, 2, 3, 3, 3, 3});
    CHECK(rays[0].power == Approx(0.25));
    CHECK(rays[3].power == Approx(0.25 / 3.0));
    CHECK(rays[6].power == Approx(0.25));
    CHECK(rays[7].power == Approx(0.75));
    CHECK(rays[7].origin.x == 2.0);
    for (std::uint64_t number = 14; number-- > 0;)
        CHECK((lamp.emission.ray(number).origin == rays[number].origin &&
               lamp.emission.ray(number).power == rays[number].power));
    CHECK(Lamp(lab, 2).emission.ray(12).origin != rays[12].origin); // another seed, other random points
    CHECK(Lamp(lab, 2).emission.ray(1).origin == rays[1].origin);
}

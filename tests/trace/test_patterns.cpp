// What the patterns of sources promise: evenly spread, no two rays alike, on the edge where it says edge.
#include "math/sequences.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"

#include <algorithm>
#include <set>
#include <tuple>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// The largest difference between the share of the points in a box from the origin and the box's area, over
/// all boxes with corners at the points' coordinates: the star discrepancy, to within 2/points.
double star_discrepancy(std::vector<dvec2> points) {
    std::vector<double> heights;
    for (dvec2 const& p : points)
        heights.push_back(p.y);
    std::sort(heights.begin(), heights.end());
    std::sort(points.begin(), points.end(), [](dvec2 const& a, dvec2 const& b) { return a.x < b.x; });
    auto const n = static_cast<double>(points.size());
    std::vector<int> below(points.size(), 0);
    double worst = 0.0;
    for (dvec2 const& p : points) {
        auto const rank = std::lower_bound(heights.begin(), heights.end(), p.y) - heights.begin();
        for (auto i = static_cast<std::size_t>(rank); i < below.size(); ++i)
            ++below[i];
        for (std::size_t i = 0; i < below.size(); ++i)
            worst = std::max(worst, std::abs(below[i] / n - p.x * heights[i]));
    }
    return worst;
}

template <class Emitter>
std::vector<Ray> rays_of(Emitter const& emitter) {
    Lab lab;
    lab.source(emitter).wavelengths = {{450e-9, 1.0}, {550e-9, 1.0}};
    Scene const scene = build_scene(lab.experiment);
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, 1);
    std::vector<Ray> rays;
    for (std::uint64_t i = 0; i < emission.rays(); ++i)
        rays.push_back(emission.ray(i));
    return rays;
}

} // namespace

TEST_CASE("the discrepancy of sobol falls as log N / N, that of random points does not", "[sources]") {
    for (std::uint32_t n : {256u, 1024u, 4096u}) {
        std::vector<dvec2> sobol, random;
        Dice dice(5);
        for (std::uint32_t i = 0; i < n; ++i) {
            sobol.push_back(sobol_2d(i, 99));
            random.emplace_back(dice.uniform(), dice.uniform());
        }
        CAPTURE(n);
        // N D* ≤ m/2 + 2 for a (0, m, 2)-net of N = 2^m points in base 2 (Niederreiter 1992, theorem 4.5),
        // and up to 2 for where the corners stand
        CHECK(star_discrepancy(sobol) * n <= 0.5 * std::log2(n) + 4.0);
        CHECK(star_discrepancy(random) > 3.0 * star_discrepancy(sobol));
    }
}

TEST_CASE("no two rays of a source of random or sobol points are alike", "[sources]") {
    auto const check = [](std::vector<Ray> const& rays) {
        std::set<std::tuple<std::uint32_t, double, double, double, double, double, double>> seen;
        for (Ray const& ray : rays)
            seen.emplace(ray.wavelength.value, ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x,
                         ray.direction.y, ray.direction.z);
        CHECK(seen.size() == rays.size());
    };
    dvec3 const z(0.0, 0.0, 1.0), y(0.0, 1.0, 0.0);
    for (Pattern pattern : {Pattern::random, Pattern::sobol})
        check(rays_of(Beam{dvec3(0.0), z, y, 0.01, dvec2(0.0), {}, pattern, 5000}));
    check(rays_of(PointEmitter{dvec3(0.0), z, y, 1.0, 5000}));
    check(rays_of(LambertianEmitter{dvec3(0.0), z, y, {0.01, 0.02}, 5000}));
}

TEST_CASE("an edge lies on the outline, at equal steps", "[sources]") {
    dvec2 const size(0.04, 0.01);
    for (std::uint64_t count : {4, 10, 100}) {
        std::vector<dvec2> const points = edge_of_rectangle(count, size);
        REQUIRE(points.size() == count);
        CHECK(points.front() == dvec2(0.5, 0.0));
        dvec2 centre(0.0);
        for (dvec2 const& p : points) {
            CHECK(std::max(std::abs(p.x), std::abs(p.y)) == Approx(0.5).epsilon(1e-14));
            centre += p;
        }
        CHECK(length(centre) < 1e-12);
        for (std::size_t i = 1; count == 100 && i < points.size();
             ++i) { // 1 mm along the outline; less over a corner
            double const step = length(size * (points[i] - points[i - 1]));
            CHECK(step < 0.001 * (1.0 + 1e-12));
            CHECK(step > 0.0007);
        }
    }
}

TEST_CASE("a Lambertian area shines evenly from all of it, by the cosine law", "[sources]") {
    dvec3 const z(0.0, 0.0, 1.0), y(0.0, 1.0, 0.0);
    std::vector<Ray> const rays = rays_of(LambertianEmitter{dvec3(0.0), z, y, {0.02, 0.01}, 20'000});
    auto const n = static_cast<double>(rays.size());
    double in_quarter = 0.0, mean_cosine = 0.0;
    std::vector<double> within(4, 0.0);
    for (Ray const& ray : rays) {
        in_quarter += (ray.origin.x > 0.0 && ray.origin.y > 0.0) / n;
        mean_cosine += ray.direction.z / n;
        for (int k = 0; k < 4; ++k) // sin² θ of the power goes within θ
            within[static_cast<std::size_t>(k)] +=
                (1.0 - ray.direction.z * ray.direction.z < 0.2 * (k + 1)) / n;
    }
    CHECK(in_quarter == Approx(0.25).epsilon(0.01));
    CHECK(mean_cosine == Approx(2.0 / 3.0).margin(4.0 * 0.236 / std::sqrt(n))); // four standard errors
    for (int k = 0; k < 4; ++k)
        CHECK(within[static_cast<std::size_t>(k)] == Approx(0.2 * (k + 1)).margin(4.0 * 0.5 / std::sqrt(n)));
}

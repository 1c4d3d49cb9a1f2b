// Patterns of points: as many as asked and hardly more, inside, no two alike, and each for an equal area.
#include "math/random.h"
#include "math/sequences.h"
#include "support/catch.h"

#include <algorithm>
#include <cmath>
#include <functional>

using namespace sahl;

namespace {

/// Smallest distance between two points, by sorting along x.
double closest_pair(std::vector<dvec2> points) {
    std::sort(points.begin(), points.end(), [](dvec2 const& a, dvec2 const& b) { return a.x < b.x; });
    double nearest = 1e9;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size() && points[j].x - points[i].x < nearest; ++j)
            nearest = std::min(nearest, length(points[j] - points[i]));
    return nearest;
}

dvec2 mean(std::vector<dvec2> const& points) {
    dvec2 sum(0.0);
    for (dvec2 const& p : points)
        sum += p;
    return sum / static_cast<double>(points.size());
}

double mean_square_radius(std::vector<dvec2> const& points) {
    double sum = 0.0;
    for (dvec2 const& p : points)
        sum += dot(p, p);
    return sum / static_cast<double>(points.size());
}

/// Largest difference between the share of the points in a box [0, a) × [0, b) and its area, over a grid of
/// corners.
double discrepancy(std::vector<dvec2> const& points) {
    double worst = 0.0;
    for (int i = 1; i <= 32; ++i)
        for (int j = 1; j <= 32; ++j) {
            double const a = i / 32.0 - 0.013,
                         b = j / 32.0 - 0.007; // off the dyadic corners, where it is trivially 0
            auto const inside = std::count_if(points.begin(), points.end(),
                                              [&](dvec2 const& p) { return p.x < a && p.y < b; });
            worst = std::max(
                worst, std::abs(static_cast<double>(inside) / static_cast<double>(points.size()) - a * b));
        }
    return worst;
}

std::vector<dvec2> sobol(std::uint32_t from, std::uint32_t count, std::uint64_t seed) {
    std::vector<dvec2> points;
    for (std::uint32_t i = 0; i < count; ++i)
        points.push_back(sobol_2d(from + i, seed));
    return points;
}

} // namespace

TEST_CASE("Sobol points fill every dyadic box exactly once") {
    constexpr int bits = 8;
    for (std::uint64_t const seed : {0ULL, 1ULL, 12345678901234ULL})
        for (std::uint32_t const from : {0U, 256U, 0x7FFFFF00U}) {
            auto const points = sobol(from, 1U << bits, seed);
            for (int columns = 0; columns <= bits; ++columns) {
                std::vector<int> boxes(1U << bits);
                for (dvec2 const& p : points) {
                    REQUIRE((p.x >= 0.0 && p.x < 1.0 && p.y >= 0.0 && p.y < 1.0));
                    auto const i = static_cast<std::size_t>(std::ldexp(p.x, columns));
                    auto const j = static_cast<std::size_t>(std::ldexp(p.y, bits - columns));
                    ++boxes[(j << columns) + i];
                }
                CHECK(std::all_of(boxes.begin(), boxes.end(), [](int n) { return n == 1; }));
            }
        }
}

TEST_CASE("Sobol points of different seeds differ and those of one seed are always the same") {
    CHECK(sobol(0, 100, 1) == sobol(0, 100, 1));
    int same = 0;
    for (std::uint32_t i = 0; i < 1000; ++i)
        same += sobol_2d(i, 1) == sobol_2d(i, 2);
    CHECK(same == 0);
    CHECK(closest_pair(sobol(0, 1 << 14, 3)) > 0.0);
}

TEST_CASE("over many seeds each Sobol point is uniform in the square") {
    // The mean of 4096 uniform numbers is within 4.5 sigmas of 1/2, sigma = √(1/12/4096).
    for (std::uint32_t const index : {0U, 1U, 77U}) {
        std::vector<dvec2> points;
        for (std::uint64_t seed = 0; seed < 4096; ++seed)
            points.push_back(sobol_2d(index, seed));
        CHECK(std::abs(mean(points).x - 0.5) < 4.5 * std::sqrt(1.0 / 12 / 4096));
        CHECK(std::abs(mean(points).y - 0.5) < 4.5 * std::sqrt(1.0 / 12 / 4096));
    }
}

TEST_CASE("the discrepancy of Sobol points is a fraction of that of random ones") {
    constexpr std::uint32_t count = 4000; // no power of two
    std::vector<dvec2> random;
    for (std::uint32_t i = 0; i < count; ++i)
        random.emplace_back(uniform(1, i, 0, 0), uniform(1, i, 0, 1));
    CHECK(discrepancy(sobol(0, count, 1)) < 0.25 * discrepancy(random));
    CHECK(discrepancy(sobol(0, count, 1)) < 0.003); // random: about 1/√N = 0.016
}

TEST_CASE("the map from the square to the disk preserves area") {
    CHECK(disk_from_square({0.5, 0.5}) == dvec2(0.0));
    CHECK(length(disk_from_square({0.0, 0.3})) == Approx(1.0).epsilon(1e-15));
    CHECK(length(disk_from_square({1.0, 1.0})) == Approx(1.0).epsilon(1e-15));
    for (dvec2 const& p :
         {dvec2(0.2, 0.3), dvec2(0.7, 0.9), dvec2(0.9, 0.6), dvec2(0.1, 0.5), dvec2(0.4, 0.05)}) {
        double const h = 1e-5; // error of the central difference: h² times third derivatives, below 1e-8
        dvec2 const du = (disk_from_square(p + dvec2(h, 0)) - disk_from_square(p - dvec2(h, 0))) / (2 * h);
        dvec2 const dv = (disk_from_square(p + dvec2(0, h)) - disk_from_square(p - dvec2(0, h))) / (2 * h);
        CHECK(std::abs(du.x * dv.y - du.y * dv.x) == Approx(3.14159265358979).epsilon(1e-7));
    }
    std::vector<dvec2> points;
    for (dvec2 const& p : sobol(0, 1 << 14, 1))
        points.push_back(disk_from_square(p));
    CHECK(mean_square_radius(points) == Approx(0.5).epsilon(1e-4)); // random points: 2e-3
}

TEST_CASE("lattices in the disk have at least the points asked for and few more") {
    for (std::uint64_t asked = 1; asked <= 20000; asked += asked < 300 ? 1 : 97) {
        auto const square = square_grid_in_disk(asked).size();
        auto const hexagonal = hexagonal_in_disk(asked).size();
        CHECK(square >= asked);
        CHECK(static_cast<double>(square - asked) <= 3 * std::sqrt(static_cast<double>(asked)));
        CHECK(hexagonal >= asked);
        CHECK(hexagonal - asked < 48);
    }
    CHECK(square_grid_in_disk(0).size() == 1);
    CHECK(hexagonal_in_disk(0).size() == 1);
    CHECK(hexagonal_in_disk(1).front() == dvec2(0.0));
    CHECK(hexagonal_in_disk(7).size() == 7);
    CHECK(hexagonal_in_disk(8).size() == 13);
}

TEST_CASE("lattices in the disk are inside it and symmetric and give every point an equal area") {
    std::function<std::vector<dvec2>(std::uint64_t)> const lattices[] = {square_grid_in_disk,
                                                                         hexagonal_in_disk};
    for (auto const& lattice : lattices)
        for (std::uint64_t const asked : {1, 2, 5, 7, 40, 1000, 50000}) {
            CAPTURE(asked);
            auto const points = lattice(asked);
            CHECK(std::all_of(points.begin(), points.end(), [](dvec2 const& p) { return length(p) < 1.0; }));
            CHECK(length(mean(points)) < 1e-13);
            if (points.size() > 1)
                CHECK(closest_pair(points) > 1.5 / std::sqrt(static_cast<double>(points.size())));
            for (dvec2 const& p : points) // the mirror images are there
                if (points.size() < 2000)
                    for (dvec2 const& image : {dvec2(-p.x, p.y), dvec2(p.x, -p.y)})
                        CHECK(std::any_of(points.begin(), points.end(),
                                          [&](dvec2 const& q) { return length(q - image) < 1e-13; }));
            // A disk of N cells is right to within the cells of its rim, some √N of them, whose errors mostly
            // cancel.
            if (asked >= 40)
                CHECK(std::abs(mean_square_radius(points) - 0.5) <
                      1.0 / std::sqrt(static_cast<double>(asked)) / 2);
        }
}

TEST_CASE("lattices in a rectangle fill it evenly") {
    std::function<std::vector<dvec2>(std::uint64_t, dvec2)> const lattices[] = {square_grid_in_rectangle,
                                                                                hexagonal_in_rectangle};
    for (auto const& lattice : lattices)
        for (dvec2 const& size : {dvec2(1, 1), dvec2(3e-3, 2e-3), dvec2(0.01, 1), dvec2(5, 0.001)})
            for (std::uint64_t const asked : {1, 2, 6, 100, 997, 20000}) {
                CAPTURE(asked, size.x, size.y);
                auto const points = lattice(asked, size);
                CHECK(points.size() >= asked);
                CHECK(static_cast<double>(points.size() - asked) <=
                      1 + 1.6 * std::sqrt(static_cast<double>(asked) * std::max(1.0, size.y / size.x)));
                CHECK(std::all_of(points.begin(), points.end(), [&](dvec2 const& p) {
                    return std::abs(p.x) < size.x / 2 && std::abs(p.y) < size.y / 2;
                }));
                CHECK(length(mean(points) / size) < 1e-13);
                if (points.size() > 1)
                    CHECK(closest_pair(points) > 0.0);
            }
}

TEST_CASE("cells of the square grid in a rectangle are as nearly square as can be") {
    auto const points = square_grid_in_rectangle(600, {3, 2});
    CHECK(points.size() == 600); // 30 × 20
    CHECK(closest_pair(points) == Approx(0.1).epsilon(1e-12));
    auto const hexagonal = hexagonal_in_rectangle(10000, {1, 1});
    CHECK(closest_pair(hexagonal) == Approx(std::sqrt(2 / std::sqrt(3.0) / 10000)).epsilon(0.02));
}

TEST_CASE("a rectangle without height is a line of points") {
    auto const grid = square_grid_in_rectangle(10, {1, 0});
    CHECK(grid.size() == 10);
    CHECK(closest_pair(grid) == Approx(0.1).epsilon(1e-12));
    CHECK(square_grid_in_rectangle(10, {0, 1}).size() == 10);
    CHECK(closest_pair(hexagonal_in_rectangle(10, {1, 0})) == Approx(0.1).epsilon(1e-12));
    CHECK(closest_pair(hexagonal_in_rectangle(10, {0, 1})) == Approx(0.1).epsilon(1e-12));
}

TEST_CASE("a ring lies on the unit circle at equal steps") {
    auto const points = ring(12);
    REQUIRE(points.size() == 12);
    CHECK(points[0] == dvec2(1, 0));
    CHECK(points[3].y == Approx(1.0).epsilon(1e-15));
    CHECK(closest_pair(points) == Approx(2 * std::sin(3.14159265358979 / 12)).epsilon(1e-13));
    CHECK(ring(0).empty());
}

TEST_CASE("a fan goes from edge to edge through the axis") {
    CHECK(fan(5) == std::vector<dvec2>{{0, -1}, {0, -0.5}, {0, 0}, {0, 0.5}, {0, 1}});
    CHECK(fan(2) == std::vector<dvec2>{{0, -1}, {0, 1}});
    CHECK(fan(1) == std::vector<dvec2>{{0, 0}});
    CHECK(fan(101)[50] == dvec2(0.0));
    CHECK(fan(0).empty());
}

#include "support/catch.h"

#include "math/brent.h"

#include <cmath>

using namespace sahl;

TEST_CASE("Brent finds the least value of a smooth function to the square root of rounding") {
    unsigned made = 0;
    auto const f = [&](double x) {
        ++made;
        return std::cosh(x - 0.7) + 2.0; // least 3 at 0.7
    };
    auto const found = brent_minimum(f, -2.0, 5.0, 1e-9, 100);
    REQUIRE(found);
    CHECK(std::abs(found->x - 0.7) < 4.0 * std::sqrt(3.0 * 2.3e-16)); // where rounding hides the change of f
    CHECK(std::abs(found->y - 3.0) < 1e-15);
    CHECK(made < 60);
    CHECK_FALSE(brent_minimum(f, -2.0, 5.0, 1e-9, 5));
}

TEST_CASE("Brent finds the least value at an end, and of a function with a corner") {
    auto const slope = brent_minimum([](double x) { return x; }, 1.0, 2.0, 1e-9, 200);
    REQUIRE(slope);
    CHECK(std::abs(slope->x - 1.0) < 4e-9);
    auto const corner = brent_minimum([](double x) { return std::abs(x - 0.3); }, -1.0, 1.0, 1e-9, 200);
    REQUIRE(corner);
    CHECK(std::abs(corner->x - 0.3) < 4e-9);
}

TEST_CASE("Brent finds a zero to rounding, from either side, and where it is flat") {
    auto const f = [](double x) { return std::exp(x) - 2.0; };
    for (auto const& [a, b] : {std::pair{0.0, 3.0}, std::pair{3.0, 0.0}}) {
        auto const found = brent_zero(f, a, f(a), b, f(b), 0.0, 60);
        REQUIRE(found);
        CHECK(std::abs(found->x - std::log(2.0)) < 1e-15);
    }
    auto const cube = [](double x) { return (x - 0.5) * (x - 0.5) * (x - 0.5); };
    auto const flat = brent_zero(cube, -1.0, cube(-1.0), 4.0, cube(4.0), 1e-12, 300);
    REQUIRE(flat);
    CHECK(std::abs(flat->x - 0.5) < 1e-5); // (1e-5)³ = 1e-15
    auto const step = [](double x) { return x < 0.25 ? -1.0 : 1.0; };
    auto const jump = brent_zero(step, 0.0, -1.0, 1.0, 1.0, 1e-12, 100);
    REQUIRE(jump);
    CHECK(std::abs(jump->x - 0.25) < 1e-11);
    CHECK_FALSE(brent_zero(f, 0.0, f(0.0), 3.0, f(3.0), 0.0, 2));
}

// Which sizes make a shape, how its faces are called, and what is said of those that do not exist.
#include "geometry/shape.h"
#include "geometry/shape_oracle.h"
#include "support/catch.h"

#include <limits>
#include <numbers>
#include <string>
#include <vector>

using namespace sahl;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();

std::vector<std::string> names(Shape const& shape) {
    auto const all = face_names(shape);
    return {all.begin(), all.end()};
}

} // namespace

TEST_CASE("shapes that exist have no problem, and their faces the names of the contract") {
    for (auto const& [name, shape] : bench::closed_shapes()) {
        INFO(name);
        CHECK(shape_problem(shape).empty());
        CHECK_FALSE(is_open(shape));
    }
    for (Shape const& shape :
         {Shape(Plane{}), Shape(Rectangle{{1.0, 2.0}}), Shape(Disk{1.0}), Shape(Disk{1.0, 0.5})}) {
        CHECK(shape_problem(shape).empty());
        CHECK(is_open(shape));
        CHECK(names(shape) == std::vector<std::string>{"surface"});
    }
    using Names = std::vector<std::string>;
    CHECK(names(Sphere{1.0}) == Names{"surface"});
    CHECK(names(Box{dvec3(1.0)}) == Names{"left", "right", "bottom", "top", "back", "front"});
    CHECK(names(Cylinder{1.0, 1.0}) == Names{"side", "back", "front"});
    CHECK(names(Lens{1.0, 1.0, 1.0, 1.0}) == Names{"front", "back", "edge"});
    CHECK(names(Prism{1.0, 1.0, 1.0}) == Names{"left", "right", "base", "near", "far"});
}

TEST_CASE("sizes that make no shape are told apart from those that do") {
    for (double bad : {0.0, -1.0, no_number, inf}) {
        CAPTURE(bad);
        for (Shape const& shape :
             {Shape(Sphere{bad}), Shape(Box{{bad, 1.0, 1.0}}), Shape(Box{{1.0, 1.0, bad}}),
              Shape(Cylinder{bad, 1.0}), Shape(Cylinder{1.0, bad}), Shape(Lens{1.0, -1.0, bad, 0.1}),
              Shape(Lens{1.0, -1.0, 0.1, bad}), Shape(Prism{1.0, bad, 1.0}), Shape(Prism{1.0, 1.0, bad}),
              Shape(Prism{bad, 1.0, 1.0}), Shape(Rectangle{{bad, 1.0}}), Shape(Rectangle{{1.0, bad}}),
              Shape(Disk{bad})})
            CHECK_FALSE(shape_problem(shape).empty());
    }
    CHECK_FALSE(shape_problem(Prism{std::numbers::pi, 1.0, 1.0}).empty());
    CHECK_FALSE(shape_problem(Lens{no_number, 0.0, 0.1, 0.1}).empty());
    CHECK_FALSE(shape_problem(Lens{0.0, inf, 0.1, 0.1}).empty());
    for (double hole : {-0.1, 1.0, 2.0, no_number})
        CHECK_FALSE(shape_problem(Disk{1.0, hole}).empty());
}

TEST_CASE("a lens must reach its rim, and be of some thickness there, the edge itself will do") {
    CHECK(shape_problem(Lens{0.01, -0.01, 0.02, 0.02}).empty()); // a ball
    CHECK(shape_problem(Lens{0.01, 0.0, 0.01, 0.02}).empty());   // half of one
    CHECK_FALSE(shape_problem(Lens{0.01, -0.01, 0.019, 0.02}).empty());
    CHECK_FALSE(shape_problem(Lens{0.00999, -0.01, 0.02, 0.02}).empty());
    CHECK(shape_problem(Lens{-0.01, 0.01, 1e-6, 0.02}).empty()); // hollow on both sides, thin in the middle
}

TEST_CASE("the remedy that is given does help") {
    // "make thickness_mm at least X mm": X, with the six digits that it has, makes a lens
    std::string const problem = shape_problem(Lens{0.03, -0.03, 0.001, 0.02});
    auto const at = problem.find("at least ");
    REQUIRE(at != std::string::npos);
    double const thickness = std::stod(problem.substr(at + 9)) * 1e-3;
    CHECK(thickness == Approx(2.0 * (0.03 - std::sqrt(0.03 * 0.03 - 0.01 * 0.01))).epsilon(1e-6));
    CHECK(shape_problem(Lens{0.03, -0.03, thickness, 0.02}).empty());
}

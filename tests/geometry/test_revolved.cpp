// A conic of revolution met in closed form against the search that brackets every root. The search takes
// over where there are aspheric terms, and a term of no size leaves the surface as it is.
#include "geometry/revolved.h"
#include "support/catch.h"
#include "support/dice.h"

#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

struct Pair {
    RevolvedSheet closed, searched;

    Pair(double curvature, double conic, double aperture)
        : closed({curvature, conic, {}}, aperture), searched({curvature, conic, {0.0}}, aperture) {}
};

std::vector<Pair> pairs() {
    std::vector<Pair> all;
    for (double const curvature : {0.9, -0.5, 0.02})
        for (double const conic : {0.0, -0.6, -1.0, -2.5, 1.5}) {
            double const reach = Revolved{curvature, conic, {}}.reach();
            for (double const share : {0.3, 0.999, 1.0})
                all.emplace_back(curvature, conic, share * std::min(reach, 2.0));
        }
    return all;
}

/// How far two ways of computing a root may differ: the surface's rounding where coordinates are of size
/// `scale`, over how steeply the line meets it.
void check_same(Pair const& pair, dvec3 const& origin, dvec3 const& direction, double scale, bool extended) {
    double const rounding = 1e-14 * scale;
    auto const one = pair.closed.roots(origin, direction, rounding, extended),
               other = pair.searched.roots(origin, direction, rounding, extended);
    CAPTURE(pair.closed.form().curvature, pair.closed.form().conic, pair.closed.aperture(), origin.x,
            origin.y, origin.z, direction.x, direction.y, direction.z, extended);
    REQUIRE(one.size() == other.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        CHECK(one[i].rises == other[i].rises);
        CHECK(one[i].slope == Approx(other[i].slope).margin(1e-7));
        CHECK(std::abs(one[i].t - other[i].t) * std::max(one[i].slope, 1e-8) <= 8e-16 * scale);
    }
}

} // namespace

TEST_CASE("a conic is met in closed form where the bracketing search meets it", "[geometry]") {
    Dice dice(11);
    std::size_t met = 0;
    for (Pair const& pair : pairs()) {
        double const h = pair.closed.aperture();
        for (int k = 0; k < 4000; ++k) {
            double const away = k % 3 == 0 ? 1.0 : k % 3 == 1 ? 10.0 : 1e3;
            dvec3 const to(dice.between(-h, h), dice.between(-h, h), dice.between(-2.0 * h, 2.0 * h));
            dvec3 const direction = dice.direction();
            dvec3 const origin = to - away * h * direction;
            met += pair.closed.roots(origin, direction, 1e-14 * away, false).size();
            check_same(pair, origin, direction, away * h + length(to), k % 2 == 0);
        }
    }
    CHECK(met > 20000);
}

TEST_CASE("a conic is met in closed form from places on it, and at grazing angles", "[geometry]") {
    Dice dice(12);
    for (Pair const& pair : pairs()) {
        double const h = pair.closed.aperture();
        for (int k = 0; k < 3000; ++k) {
            double const r = h * std::sqrt(dice.uniform()), azimuth = dice.between(0.0, 6.3);
            dvec3 p(r * std::cos(azimuth), r * std::sin(azimuth), pair.closed.form().sag(r));
            dvec3 const normal = pair.closed.settle(p);
            dvec3 direction = dice.direction();
            if (k % 3 == 0) // nearly along it
                direction = normalize(direction - (1.0 - std::pow(10.0, dice.between(-9.0, -1.0))) *
                                                      dot(direction, normal) * normal);
            double const rounding = 1e-14 * (h + length(p));
            auto const one = pair.closed.roots(p, direction, rounding, false),
                       other = pair.searched.roots(p, direction, rounding, false);
            CAPTURE(pair.closed.form().curvature, pair.closed.form().conic, h, p.x, p.y, p.z, direction.x,
                    direction.y, direction.z);
            REQUIRE(one.size() == other.size());
            for (std::size_t i = 0; i < one.size(); ++i) {
                CHECK(one[i].rises == other[i].rises);
                CHECK(std::abs(one[i].t - other[i].t) * std::max(one[i].slope, 1e-8) <=
                      2e-15 * (h + length(p)));
            }
        }
    }
}

TEST_CASE("where a sum of large terms rounds, a line crosses a surface no more often than it does",
          "[geometry]") {
    // as below, evenly spread: coefficients of 1e5 that leave heights of 1e-7
    constexpr int ripples = 13;
    std::vector<double> terms{3e3};
    for (int j = 1; j <= ripples; ++j) {
        double const root = j / 14.0;
        terms.push_back(0.0);
        for (std::size_t i = terms.size() - 1; i > 0; --i)
            terms[i] = terms[i - 1] - root * terms[i];
        terms[0] *= -root;
    }
    RevolvedSheet const sheet({0.0, 0.0, terms}, 1.0);
    auto const roots = sheet.roots({-2.0, 0.2, 0.0}, {1.0, 0.0, 0.0}, 1e-14, false);
    REQUIRE(roots.size() == 2 * ripples);
    for (auto const& root : roots) {
        double const s = (root.t - 2.0) * (root.t - 2.0) + 0.04;
        CHECK(s * 14.0 ==
              Approx(std::round(s * 14.0)).margin(1e-2)); // what rounding leaves of the shallowest
    }
}

TEST_CASE("a surface of as many ripples as its terms allow is crossed at each of them", "[geometry]") {
    // A s² (s − s₁) … (s − s₉) over s = r², multiplied out; denser towards both ends, where it stays small
    constexpr int ripples = 9;
    std::vector<double> terms{3e3}, places;
    for (int j = 1; j <= ripples; ++j) {
        double const root = 0.55 - 0.45 * std::cos(3.14159265358979 * (j - 0.5) / ripples);
        places.push_back(root);
        terms.push_back(0.0);
        for (std::size_t i = terms.size() - 1; i > 0; --i)
            terms[i] = terms[i - 1] - root * terms[i];
        terms[0] *= -root;
    }
    REQUIRE(terms.size() <= most_aspheric_terms);
    RevolvedSheet const sheet({0.0, 0.0, terms}, 1.0);
    auto const roots = sheet.roots({-2.0, 0.01, 0.0}, {1.0, 0.0, 0.0}, 1e-14, false);
    REQUIRE(roots.size() == 2 * ripples);
    for (std::size_t i = 0; i < roots.size(); ++i) {
        double const x = roots[i].t - 2.0, s = x * x + 1e-4;
        std::size_t const k = i < ripples ? ripples - 1 - i : i - ripples;
        CHECK(s == Approx(places[k]).margin(1e-9)); // the sum's cancellation
        CHECK((i == 0 || roots[i].rises != roots[i - 1].rises));
    }
    CHECK(shape_problem(Lens{0.0, 0.0, 1.0, 0.5, 0.0, 0.0, std::vector<double>(15, 1e-3)}).empty());
    CHECK(shape_problem(Lens{0.0, 0.0, 1.0, 0.5, 0.0, 0.0, std::vector<double>(16, 1e-3)})
              .find("15 coefficients") != std::string::npos);
}

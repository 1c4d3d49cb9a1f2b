// The numbered formulas of catalogues: against what their coefficients must give, and against each other.
#include "materials/formulas.h"
#include "support/catch.h"

#include <cmath>

using namespace sahl;

namespace {

using List = std::vector<double>;

constexpr double um = 0.55; // the wavelength at which all are evaluated

double page(int number, List const& c) {
    auto const formula = page_formula(number, c);
    REQUIRE(formula.has_value());
    return refractive_index(*formula, um * 1e-6);
}

double agf(int number, List const& c) {
    auto const formula = agf_formula(number, c);
    REQUIRE(formula.has_value());
    return refractive_index(*formula, um * 1e-6);
}

double const x = um * um;

} // namespace

TEST_CASE("formulas of refractiveindex.info pages give their definitions") {
    CHECK(page(1, {0.1, 1.1, 0.1, 0.9, 10}) ==
          Approx(std::sqrt(1.1 + 1.1 * x / (x - 0.01) + 0.9 * x / (x - 100))).epsilon(1e-15));
    CHECK(page(2, {0.1, 1.1, 0.01}) == Approx(std::sqrt(1.1 + 1.1 * x / (x - 0.01))).epsilon(1e-15));
    CHECK(page(3, {2.2, -0.006, 2, 0.008, -2}) ==
          Approx(std::sqrt(2.2 - 0.006 * x + 0.008 / x)).epsilon(1e-15));
    CHECK(page(4, {2.1, 0.02, 0, 0.2, 2, 0.9, 2, 8, 2, -0.01, 2, 0.001, 4}) ==
          Approx(std::sqrt(2.1 + 0.02 / (x - 0.04) + 0.9 * x / (x - 64) - 0.01 * x + 0.001 * x * x))
              .epsilon(1e-15));
    CHECK(page(4, {2.1, 0.02, 2, 0.2, 1}) == Approx(std::sqrt(2.1 + 0.02 * x / (x - 0.2))).epsilon(1e-15));
    CHECK(page(5, {1.5, 0.004, -2, 1e-4, -4}) == Approx(1.5 + 0.004 / x + 1e-4 / (x * x)).epsilon(1e-15));
    CHECK(page(7, {1.5, 0.01, 1e-4, -1e-3, 1e-4, 1e-5}) ==
          Approx(1.5 + 0.01 / (x - 0.028) + 1e-4 / std::pow(x - 0.028, 2) - 1e-3 * x + 1e-4 * x * x +
                 1e-5 * x * x * x)
              .epsilon(1e-15));
    double const n8 = page(8, {0.2, 0.1, 0.01, -0.001}), n8_squared = n8 * n8;
    CHECK((n8_squared - 1) / (n8_squared + 2) ==
          Approx(0.2 + 0.1 * x / (x - 0.01) - 0.001 * x).epsilon(1e-14));
    CHECK(page(9, {2.3, 0.013, 0.03, 0.002, 0.2, 0.01}) ==
          Approx(std::sqrt(2.3 + 0.013 / (x - 0.03) + 0.002 * (um - 0.2) / (std::pow(um - 0.2, 2) + 0.01)))
              .epsilon(1e-15));
}

TEST_CASE("formulas of AGF files give their definitions") {
    CHECK(agf(1, {2.2, -0.01, 0.01, 2e-4, 1e-5, 1e-6}) ==
          Approx(std::sqrt(2.2 - 0.01 * x + 0.01 / x + 2e-4 / std::pow(x, 2) + 1e-5 / std::pow(x, 3) +
                           1e-6 / std::pow(x, 4)))
              .epsilon(1e-15));
    CHECK(agf(4, {1.1, 0.1, 0.2, 0.01, 0.3}) ==
          Approx(std::sqrt(1 + 1.1 + 0.1 * x / (x - 0.04) + 0.01 / (x - 0.09))).epsilon(1e-15));
    CHECK(agf(5, {1.5, 0.01, 0.002}) == Approx(1.5 + 0.01 / um + 0.002 / std::pow(um, 3.5)).epsilon(1e-15));
    CHECK(agf(7, {2.2, 0.02, 0.03, 0.01}) ==
          Approx(std::sqrt(2.2 + 0.02 / (x - 0.03) - 0.01 * x)).epsilon(1e-15));
    CHECK(agf(8, {2.2, 0.02, 0.03, 0.01}) ==
          Approx(std::sqrt(2.2 + 0.02 * x / (x - 0.03) - 0.01 * x)).epsilon(1e-15));
    CHECK(agf(9, {1.4, 0.9, 0.01, 1.1, 100}) ==
          Approx(std::sqrt(1.4 + 0.9 * x / (x - 0.01) + 1.1 * x / (x - 100))).epsilon(1e-15));
    CHECK(agf(10, {2.2, -0.01, 0.01, 0, 0, 0, 1e-7, 1e-8}) ==
          Approx(std::sqrt(2.2 - 0.01 * x + 0.01 / x + 1e-7 / std::pow(x, 5) + 1e-8 / std::pow(x, 6)))
              .epsilon(1e-15));
    CHECK(agf(12, {2.2, -0.01, 0.01, 0, 0, 0, 1e-4, 1e-5}) ==
          Approx(std::sqrt(2.2 - 0.01 * x + 0.01 / x + 1e-4 * x * x + 1e-5 * x * x * x)).epsilon(1e-15));
    CHECK(agf(13, {2.2, -0.01, -1e-4, 0.01, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) ==
          Approx(std::sqrt(2.2 - 0.01 * x - 1e-4 * x * x + 0.01 / x + 1e-4 / std::pow(x, 2) +
                           1e-5 / std::pow(x, 3) + 1e-6 / std::pow(x, 4) + 1e-7 / std::pow(x, 5) +
                           1e-8 / std::pow(x, 6)))
              .epsilon(1e-15));
}

TEST_CASE("the same glass has the same index by every formula that can express it") {
    List const bk7{1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653};
    double const n = agf(2, bk7);
    CHECK(n == Approx(1.518522387).margin(1e-9)); // SCHOTT's coefficients, at 550 nm
    List page_2{0.0};
    page_2.insert(page_2.end(), bk7.begin(), bk7.end());
    CHECK(page(2, page_2) == n);
    for (int const number : {6, 11}) // more terms, which are 0
        CHECK(agf(number, bk7) == n);
    List const herzberger{1.5, 0.01, 1e-4, -1e-3, 1e-4, 1e-5};
    CHECK(agf(3, herzberger) == page(7, herzberger));
}

TEST_CASE("a number that is no formula, and a wrong count of coefficients, are none") {
    for (int const number : {-1, 0, 10})
        CHECK_FALSE(page_formula(number, List{1, 2, 3}).has_value());
    for (int const number : {0, 14})
        CHECK_FALSE(agf_formula(number, List{1, 2, 3}).has_value());
    CHECK_FALSE(agf_formula(2, List(11, 0.1)).has_value());
    for (int number = 1; number <= 9; ++number)
        CHECK_FALSE(page_formula(number, List{}).has_value());
    for (int number = 1; number <= 6; ++number)
        CHECK_FALSE(page_formula(number, List{1, 2}).has_value());
    CHECK_FALSE(page_formula(8, List{1, 2, 3}).has_value());
    CHECK_FALSE(page_formula(9, List{1, 2, 3, 4, 5}).has_value());
}

TEST_CASE(
    "an index relative to vacuum is divided by that of air, at the vacuum's wavelength where this is meant") {
    auto const cauchy = std::make_shared<AnyDispersion const>(AnyDispersion{Cauchy{1.32, 0.003, 0}});
    double const air = 1 / refractive_index(VacuumIndex{}, um * 1e-6);
    auto const at = [&](bool index, bool wavelength) {
        return refractive_index(AbsoluteIndex{cauchy, index, wavelength}, um * 1e-6);
    };
    CHECK(at(false, false) == refractive_index(cauchy->formula, um * 1e-6));
    CHECK(at(true, false) == Approx((1.32 + 0.003 / x) / air).epsilon(1e-15));
    CHECK(at(true, true) == Approx((1.32 + 0.003 / (x * air * air)) / air).epsilon(1e-15));
    CHECK(at(false, true) == Approx(1.32 + 0.003 / (x * air * air)).epsilon(1e-15));
}

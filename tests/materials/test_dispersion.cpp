// The dispersion formulas: against 50-digit arithmetic, against their own definitions, and at their edges.
#include "materials/dispersion.h"
#include "support/catch.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

using namespace sahl;

namespace {

constexpr double line_f = 486.1327e-9, line_d = 587.5618e-9, line_c = 656.2725e-9; // m; H, He, H

double abbe_number(Dispersion const& index) {
    return (refractive_index(index, line_d) - 1) /
           (refractive_index(index, line_f) - refractive_index(index, line_c));
}

} // namespace

TEST_CASE("Sellmeier indices agree with 50-digit arithmetic to 1e-14") {
    std::filesystem::path const file = std::filesystem::path(SAHL_SHARED_DATA) / "truth_public.json";
    if (!std::filesystem::exists(file)) {
        WARN("skipped: no shared data");
        return;
    }
    auto const truth = nlohmann::json::parse(std::ifstream(file));
    int cases = 0;
    for (auto const& item : truth["cases"]) {
        if (item["kind"] != "sellmeier")
            continue;
        ++cases;
        auto const& in = item["inputs"];
        Dispersion const index =
            Sellmeier{in["B"].get<std::vector<double>>(), in["C_um2"].get<std::vector<double>>()};
        for (auto const& [line, um] : in["wavelength_um"].items()) {
            CAPTURE(item["id"].get<std::string>(), line);
            double const expected = std::stod(item["outputs"]["n_" + line].get<std::string>());
            CHECK(std::abs(refractive_index(index, um.get<double>() * 1e-6) - expected) <= 1e-14);
        }
        // n_F − n_C is 0.008 … 0.026: an error of 2 ulp (4e-16) in each is 1e-13 of it, and V is up to 100.
        CHECK(abbe_number(index) ==
              Approx(std::stod(item["outputs"]["abbe_Vd"].get<std::string>())).epsilon(2e-13));
    }
    CHECK(cases > 0);
}

TEST_CASE("the Sellmeier index of N-BK7 is that of 50-digit arithmetic") {
    Dispersion const bk7 =
        Sellmeier{{1.03961212, 0.231792344, 1.01046945}, {0.00600069867, 0.0200179144, 103.560653}};
    CHECK(std::abs(refractive_index(bk7, line_f) - 1.5223762897312287) <= 1e-14);
    CHECK(std::abs(refractive_index(bk7, line_d) - 1.5168000345005885) <= 1e-14);
    CHECK(std::abs(refractive_index(bk7, line_c) - 1.5143223472613747) <= 1e-14);
}

TEST_CASE("the formula of KHR_materials_dispersion gives back the index and the Abbe number it is made of") {
    for (double const vd : {20.0, 36.4, 89.3}) {
        Dispersion const index = AbbeIndex{1.62, vd};
        // Its constants have six and five digits: 523655/587.5618² = 1.51683, not 1.5168; 523655 (1/F² −
        // 1/C²) = 0.99997.
        CHECK(std::abs(refractive_index(index, line_d) - 1.62) < 4e-5 * 0.62 / vd);
        CHECK(abbe_number(index) == Approx(vd).epsilon(4e-5));
    }
    CHECK(refractive_index(AbbeIndex{1.01, 1.0}, 2000e-9) == 1.0); // never below 1
    CHECK(refractive_index(AbbeIndex{1.5, std::numeric_limits<double>::infinity()}, 400e-9) == 1.5);
}

TEST_CASE("the other formulas give their definitions") {
    double const um = 0.55, square = um * um;
    CHECK(refractive_index(ConstantIndex{1.45}, um * 1e-6) == 1.45);
    CHECK(refractive_index(Cauchy{1.5, 0.004, 1e-5}, um * 1e-6) ==
          Approx(1.5 + 0.004 / square + 1e-5 / (square * square)).epsilon(1e-15));
    CHECK(refractive_index(PowerSeries{2.2, {{-0.006, 2}, {0.008, -2}}}, um * 1e-6) ==
          Approx(std::sqrt(2.2 - 0.006 * square + 0.008 / square)).epsilon(1e-15));
    CHECK(refractive_index(Sellmeier{{1.2}, {0.01}, 0.05}, um * 1e-6) ==
          Approx(std::sqrt(1.05 + 1.2 * square / (square - 0.01))).epsilon(1e-15));
}

TEST_CASE("vacuum is one over the index of standard air") {
    // Ciddor 1996 at 632.99 nm: n − 1 = 2.765e-4, a figure of every textbook.
    CHECK(1 / refractive_index(VacuumIndex{}, 632.99e-9) - 1 == Approx(2.765e-4).epsilon(2e-4));
    double const air = 1 + 0.05792105 / (238.0185 - 4.0) + 0.00167917 / (57.362 - 4.0); // at ½ µm
    CHECK(refractive_index(VacuumIndex{}, 500e-9) == Approx(1 / air).epsilon(1e-15));
}

TEST_CASE("a gas that is air has the index 1 relative to air") {
    GasIndex const air{0.0, {{0.05792105, 238.0185}, {0.00167917, 57.362}}};
    CHECK(refractive_index(air, 450e-9) == 1.0);
    CHECK(refractive_index(GasIndex{0.0, {}}, 450e-9) == refractive_index(VacuumIndex{}, 450e-9));
}

TEST_CASE("a table is linear in between and constant beyond its ends") {
    Dispersion const table = TabulatedIndex{{{400e-9, 1.54}, {500e-9, 1.52}, {700e-9, 1.51}}};
    CHECK(refractive_index(table, 300e-9) == 1.54);
    CHECK(refractive_index(table, 400e-9) == 1.54);
    CHECK(refractive_index(table, 425e-9) == Approx(1.535).epsilon(1e-14));
    CHECK(refractive_index(table, 500e-9) == 1.52);
    CHECK(refractive_index(table, 600e-9) == Approx(1.515).epsilon(1e-14));
    CHECK(refractive_index(table, 700e-9) == 1.51);
    CHECK(refractive_index(table, 900e-9) == 1.51);
    CHECK(refractive_index(TabulatedIndex{{{500e-9, 1.5}}}, 900e-9) == 1.5);
}

TEST_CASE("where a formula has no real value the index is not a number") {
    CHECK(std::isnan(refractive_index(Sellmeier{{1.0}, {0.25}}, 500e-9))); // at the resonance
    CHECK(std::isnan(refractive_index(Sellmeier{{1.0}, {0.25}}, 490e-9))); // n² < 0 just below it
    CHECK(refractive_index(Sellmeier{{1.0}, {0.25}}, 800e-9) > 1.0);
    CHECK(std::isnan(refractive_index(PowerSeries{-1.0, {}}, 500e-9)));
    CHECK(std::isnan(refractive_index(TabulatedIndex{}, 500e-9)));
}

TEST_CASE("only what changes with the wavelength disperses") {
    CHECK_FALSE(disperses(ConstantIndex{1.5}));
    CHECK_FALSE(disperses(AbbeIndex{1.5, std::numeric_limits<double>::infinity()}));
    CHECK_FALSE(disperses(Sellmeier{{0.0}, {0.01}, 1.25}));
    CHECK_FALSE(disperses(Sellmeier{{1.25}, {0.0}}));
    CHECK_FALSE(disperses(Cauchy{1.5, 0, 0}));
    CHECK_FALSE(disperses(PowerSeries{2.25, {{0.0, 2.0}}}));
    CHECK_FALSE(disperses(TabulatedIndex{{{400e-9, 1.5}, {700e-9, 1.5}}}));
    CHECK(disperses(AbbeIndex{1.5, 60}));
    CHECK(disperses(Sellmeier{{1.25}, {0.01}}));
    CHECK(disperses(Cauchy{1.5, 0.001, 0}));
    CHECK(disperses(PowerSeries{2.25, {{0.01, -2.0}}}));
    CHECK(disperses(TabulatedIndex{{{400e-9, 1.51}, {700e-9, 1.5}}}));
    CHECK(disperses(VacuumIndex{}));
    CHECK(disperses(GasIndex{0, {}}));
}

// The formulae of a boundary at the edges of their range, thinned from tests/benchmarks/formulae.cpp: worst
// errors over random and adversarial inputs, regime by regime.
#include "optics/regimes.h"
#include "support/catch.h"

using namespace sahl::bench;

TEST_CASE("shares at dielectrics are right to 100 ulp or 1e-16, and add up to 2e-15, in every regime") {
    for (Regime const& regime : dielectric_regimes()) {
        Shares4 const worst = judge_dielectric(regime, 11, 20'000);
        CAPTURE(regime.name, worst.ulps(), worst.absolute());
        CHECK(worst.inputs == 20'000);
        CHECK(worst.wrong_total == 0);
        CHECK(worst.balance <= 2e-15);
        if (regime.near_critical)
            CHECK(worst.absolute() <= 2e-7);
        else
            CHECK(worst.ulps() <= 100.0);
    }
}

TEST_CASE("shares at metals are right to 100 ulp or 1e-16, and add up to 2e-15, in every regime") {
    for (MetalRegime const& regime : metal_regimes()) {
        Shares4 const worst = judge_metal(regime, 12, 20'000);
        CAPTURE(regime.name, worst.ulps(), worst.absolute());
        CHECK(worst.balance <= 2e-15);
        if (regime.near_critical)
            CHECK(worst.absolute() <= 2e-7);
        else
            CHECK(worst.ulps() <= 100.0);
    }
}

TEST_CASE("directions are right to 2e-14 rad away from the critical angle, and total reflection is decided "
          "to rounding") {
    for (Regime const& regime : dielectric_regimes()) {
        Directions const worst = judge_directions(regime, 13, 20'000);
        CAPTURE(regime.name, worst.refracted, worst.reflected, worst.length, worst.undecided);
        CHECK(worst.reflected <= 2e-15);
        CHECK(worst.length <= 4.0 * unit_ulp);
        // sine and cosine are those of two vectors, rounded: within their rounding of the critical angle
        // either is right
        CHECK(worst.undecided <= 4.0 * unit_ulp);
        // the refracted cosine is a root: 1e-3 rad off the critical angle it has lost a factor of 30, at it
        // half the digits
        CHECK(worst.refracted <= (regime.near_critical ? 1e-7 : 2e-14));
    }
}

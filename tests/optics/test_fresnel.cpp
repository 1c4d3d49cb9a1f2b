// Fresnel's shares against the bank, against arithmetic of 113 bits, and at every edge of their range.
#include "optics/fresnel.h"
#include "support/bank.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/quad.h"
#include "support/textbook.h"

#include <algorithm>
#include <limits>

using namespace sahl;
using namespace sahl::bench;

namespace {

Incidence at_angle(double radians_) {
    return {std::cos(radians_), std::sin(radians_)};
}

/// Errors over many inputs, the worst of each kind.
struct Worst {
    double ulps = 0.0; // of values whose error is above 1e-16
    double absolute = 0.0;
    double balance = 0.0; // |R + T − 1| of unpolarised light
    int wrong_total = 0;  // wrong decisions on total internal reflection

    void compare(Incidence incidence, double n1, double n2) {
        auto const got = fresnel_dielectric(incidence, n1, n2);
        auto const exact = exact_fresnel(incidence, n1, n2);
        wrong_total += got.has_value() != exact.has_value();
        if (!got || !exact)
            return;
        Quad const expected[] = {exact->r_s, exact->r_p, exact->t_s, exact->t_p};
        double const values[] = {got->r_s, got->r_p, got->t_s, got->t_p};
        for (int i = 0; i < 4; ++i) {
            double const error = static_cast<double>(absolute_of(Quad(values[i]) - expected[i]));
            absolute = std::max(absolute, error);
            if (error > 1e-16)
                ulps = std::max(ulps, error / (std::numeric_limits<double>::epsilon() *
                                               static_cast<double>(expected[i])));
        }
        balance = std::max(balance, std::abs(got->reflectance() + got->transmittance() - 1.0));
    }
};

} // namespace

TEST_CASE("the bank's shares at a boundary between dielectrics come out to 1e-13") {
    for (BankCase const& one : bank("fresnel_dielectric")) {
        auto const shares = fresnel_dielectric(at_angle(radians(one.input("incidence_deg"))), one.input("n1"),
                                               one.input("n2"));
        if (!one.outputs.find("T_s")) {
            CHECK(!shares);
            continue;
        }
        REQUIRE(shares);
        agrees(one, "R_s", shares->r_s);
        agrees(one, "R_p", shares->r_p);
        agrees(one, "T_s", shares->t_s);
        agrees(one, "T_p", shares->t_p);
    }
}

TEST_CASE("the bank's shares at metals come out to 1e-13") {
    for (BankCase const& one : bank("fresnel_metal")) {
        FresnelShares const shares = fresnel_metal(at_angle(radians(one.input("incidence_deg"))), 1.0,
                                                   {one.input("n"), one.input("k")});
        agrees(one, "R_s", shares.r_s);
        agrees(one, "R_p", shares.r_p);
        agrees(one, "A_s", shares.t_s);
        agrees(one, "A_p", shares.t_p);
    }
}

TEST_CASE("the bank's special angles are where they should be") {
    for (BankCase const& one : bank("special_angles")) {
        double const n1 = one.input("n1"), n2 = one.input("n2");
        auto const normal = fresnel_dielectric({1.0, 0.0}, n1, n2);
        REQUIRE(normal);
        agrees(one, "R_normal", normal->r_s, 1e-14);
        agrees(one, "R_normal", normal->r_p, 1e-14);
        double const brewster = radians(one.output("brewster_deg"));
        auto const polarising = fresnel_dielectric(at_angle(brewster), n1, n2);
        REQUIRE(polarising);
        agrees(one, "R_s_at_brewster", polarising->r_s, 1e-14);
        CHECK(polarising->r_p < 1e-30);
        if (!one.outputs.find("critical_deg"))
            continue;
        double const critical = radians(one.output("critical_deg"));
        CHECK(fresnel_dielectric(at_angle(critical - 1e-13), n1, n2));
        CHECK(!fresnel_dielectric(at_angle(critical + 1e-13), n1, n2));
    }
}

TEST_CASE("shares are right to 100 ulp or 1e-16 at any angle away from the critical one") {
    Dice dice(1);
    Worst worst;
    for (int k = 0; k < 40'000; ++k) {
        double const n1 = dice.between(1.0, 4.0), n2 = dice.between(1.0, 4.0);
        double const angle = dice.between(0.0, std::numbers::pi / 2);
        if (n1 < n2 || std::abs(angle - std::asin(n2 / n1)) > 1e-3)
            worst.compare(at_angle(angle), n1, n2);
    }
    CHECK(worst.wrong_total == 0);
    CHECK(worst.ulps <= 100.0);
    CHECK(worst.balance <= 2e-15);
}

TEST_CASE("shares are right near grazing and normal incidence and between nearly equal indices") {
    Dice dice(2);
    Worst grazing, normal, matched;
    for (int k = 0; k < 20'000; ++k) {
        double const n1 = dice.between(1.0, 4.0), small = dice.log_between(1e-300, 1e-2);
        grazing.compare({std::sin(small), std::cos(small)}, n1, n1 + dice.log_between(0.01, 1.0));
        normal.compare(at_angle(small), n1, dice.between(1.0, 4.0));
        matched.compare(at_angle(dice.between(0.0, 1.57)), n1, n1 * (1.0 + dice.log_between(1e-16, 1e-3)));
    }
    for (Worst const& worst : {grazing, normal, matched}) {
        CHECK(worst.wrong_total == 0);
        CHECK(worst.ulps <= 100.0);
        CHECK(worst.balance <= 2e-15);
    }
}

TEST_CASE("index-matched media reflect nothing") {
    Dice dice(3);
    for (int k = 0; k < 10'000; ++k) {
        double const n = dice.between(1.0, 4.0), grazing = dice.log_between(1e-12, 1.5);
        auto const shares = fresnel_dielectric({std::sin(grazing), std::cos(grazing)}, n, n);
        REQUIRE(shares);
        CHECK((shares->r_s == 0.0 && shares->r_p == 0.0));
        CHECK(std::max(std::abs(shares->t_s - 1.0), std::abs(shares->t_p - 1.0)) <= 1e-15);
    }
}

TEST_CASE("near Brewster's angle the shares are right to 1e-16") {
    Dice dice(4);
    Worst worst;
    for (int k = 0; k < 20'000; ++k) {
        double const n1 = dice.between(1.0, 4.0), n2 = dice.between(1.0, 4.0);
        worst.compare(at_angle(std::atan(n2 / n1) + dice.sign() * dice.log_between(1e-17, 1e-3)), n1, n2);
    }
    CHECK(worst.wrong_total == 0);
    CHECK(worst.ulps <= 100.0);
    CHECK(worst.balance <= 2e-15);
}

TEST_CASE("no decision on total internal reflection is wrong, however near the critical angle") {
    // from 1e-6 rad down to where cosine and sine no longer change; critical angles from 1 to 90 degrees
    Dice dice(5);
    Worst worst;
    for (int k = 0; k < 100'000; ++k) {
        double const critical =
            k % 2 ? dice.between(0.02, 1.57) : std::numbers::pi / 2 - dice.log_between(1e-6, 1.0);
        double const n1 = dice.between(1.0, 4.0), n2 = n1 * std::sin(critical);
        worst.compare(at_angle(std::asin(n2 / n1) + dice.sign() * dice.log_between(1e-17, 1e-6)), n1, n2);
    }
    CAPTURE(worst.absolute, worst.balance / 1e-15);
    CHECK(worst.wrong_total == 0);
    CHECK(worst.absolute <= 2e-7); // k2 is the root of a difference that the inputs give to 1e-16
    CHECK(worst.balance <= 2e-15);
}

TEST_CASE("at the critical angle itself all is reflected, and at grazing incidence too") {
    CHECK(transmitted_normal_squared({std::sqrt(0.75), 0.5}, 2.0, 1.0) == 0.0); // exact in doubles
    CHECK(!fresnel_dielectric({std::sqrt(0.75), 0.5}, 2.0, 1.0));
    auto const grazing = fresnel_dielectric({0.0, 1.0}, 1.0, 1.5);
    REQUIRE(grazing);
    CHECK((grazing->r_s == 1.0 && grazing->t_s == 0.0 && grazing->t_p == 0.0));
    CHECK(grazing->r_p == Approx(1.0).epsilon(1e-15));
}

TEST_CASE("a transparent metal is a dielectric") {
    Dice dice(6);
    for (int k = 0; k < 1000; ++k) {
        double const n1 = dice.between(1.0, 2.0), n2 = dice.between(1.0, 2.0);
        Incidence const incidence = at_angle(dice.between(0.0, 1.5));
        FresnelShares const metal = fresnel_metal(incidence, n1, {n2, 0.0});
        auto const dielectric = fresnel_dielectric(incidence, n1, n2);
        CHECK(metal.reflectance() == Approx(dielectric ? dielectric->reflectance() : 1.0).margin(1e-12));
        CHECK(metal.transmittance() == Approx(dielectric ? dielectric->transmittance() : 0.0).margin(1e-12));
    }
}

TEST_CASE("what a metal reflects and absorbs adds up to one, each share to 1e-14") {
    // complex roots and quotients: some 20 roundings on the way to each
    Dice dice(7);
    double balance = 0.0, error = 0.0;
    for (int k = 0; k < 20'000; ++k) {
        double const small = dice.log_between(1e-12, 1.57), n1 = dice.between(1.0, 3.0);
        Incidence const incidence = k % 2 ? at_angle(small) : Incidence{std::sin(small), std::cos(small)};
        std::complex<double> const metal{dice.log_between(0.01, 10.0), dice.log_between(0.1, 20.0)};
        FresnelShares const got = fresnel_metal(incidence, n1, metal);
        ExactShares const exact = exact_metal(incidence, n1, metal);
        balance = std::max({balance, std::abs(got.r_s + got.t_s - 1.0), std::abs(got.r_p + got.t_p - 1.0)});
        for (auto const& [value, expected] : {std::pair{got.r_s, exact.r_s}, std::pair{got.r_p, exact.r_p},
                                              std::pair{got.t_s, exact.t_s}, std::pair{got.t_p, exact.t_p}})
            error = std::max(error, static_cast<double>(absolute_of(Quad(value) - expected)));
    }
    CAPTURE(balance / 1e-15, error / 1e-15);
    CHECK(balance <= 1e-14);
    CHECK(error <= 1e-14);
}

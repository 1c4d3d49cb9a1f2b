// Whether s and p are told apart as the closed forms say: phases of total reflection and of metals,
// Brewster's angle, and Jones' calculus, of which Stokes vectors are the other way to write.
#include "optics/plate.h"
#include "optics/polarisation.h"
#include "support/bank.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/textbook.h"

#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

using Complex = std::complex<double>;

Incidence at(double angle) {
    return {std::cos(angle), std::sin(angle)};
}

/// Stokes' numbers over S0 of a field along s and p, times exp(−iωt).
dvec3 stokes_of(Complex s, Complex p) {
    double const power = std::norm(s) + std::norm(p);
    Complex const pair = 2.0 * s * std::conj(p);
    return dvec3(std::norm(s) - std::norm(p), pair.real(), pair.imag()) / power;
}

void near(dvec3 const& a, dvec3 const& b, double within) {
    CAPTURE(a.x, a.y, a.z, b.x, b.y, b.z);
    CHECK(length(a - b) <= within);
}

} // namespace

TEST_CASE("total reflection parts s and p by the phases of the bank", "[polarised]") {
    for (BankCase const& c : bank("fresnel_dielectric"))
        if (c.outputs.find("relative_phase_p_minus_s_rad")) {
            SortedWays const ways =
                sorted_by_dielectric(at(radians(c.input("incidence_deg"))), c.input("n1"), c.input("n2"));
            CHECK(!ways.through);
            agrees(c, "relative_phase_p_minus_s_rad", std::arg(ways.back.pair));
            CHECK(std::abs(ways.back.pair) == Approx(1.0).epsilon(1e-15));
        }
    for (BankCase const& c : bank("fresnel_rhomb"))
        agrees(c, "relative_phase_per_tir_rad",
               std::arg(
                   sorted_by_dielectric(at(radians(c.input("incidence_deg"))), c.input("n"), 1.0).back.pair));
}

TEST_CASE("metals part s and p by the phases of the bank", "[polarised]") {
    for (BankCase const& c : bank("fresnel_metal")) {
        Sorting const back =
            sorted_by_metal(at(radians(c.input("incidence_deg"))), 1.0, {c.input("n"), c.input("k")}).back;
        // at right angles −π and π are one phase
        double const phase = std::arg(std::conj(back.pair)),
                     expected = c.output("relative_phase_rp_over_rs_rad");
        CHECK(std::remainder(phase - expected, 2.0 * std::numbers::pi) == Approx(0.0).margin(1e-13));
        CHECK(std::norm(back.pair) == Approx(back.s * back.p).epsilon(1e-13));
    }
}

// r_p / r_s at one angle tells a metal's ε (R. M. A. Azzam, N. M. Bashara, Ellipsometry and Polarized Light,
// 4.2.1): nothing of how it was computed here is in that.
TEST_CASE("what a metal does to s and p tells its index, as an ellipsometer finds it", "[polarised]") {
    Complex const index(0.18, 3.45);
    for (double const angle : {0.3, 0.9, 1.2, 1.4}) {
        Sorting const back = sorted_by_metal(at(angle), 1.0, index).back;
        Complex const ratio = std::conj(back.pair) / back.s, one = (1.0 - ratio) / (1.0 + ratio);
        double const sine = std::sin(angle), tangent = std::tan(angle);
        Complex const epsilon = sine * sine * (1.0 + tangent * tangent * one * one);
        CHECK(std::abs(epsilon - index * index) < 1e-11 * std::norm(index));
    }
}

TEST_CASE("two total reflections in a rhomb make circular light of plane light, and four turn its plane",
          "[polarised]") {
    for (BankCase const& c : bank("fresnel_rhomb")) {
        Sorting const once =
            sorted_by_dielectric(at(radians(c.output("angle45_a_deg"))), c.input("n"), 1.0).back;
        dvec3 light(0.0, 1.0, 0.0); // halfway between s and p
        for (dvec3 const& expected : {dvec3(0, std::sqrt(0.5), std::sqrt(0.5)), dvec3(0, 0, 1),
                                      dvec3(0, -std::sqrt(0.5), std::sqrt(0.5)), dvec3(0, -1, 0)}) {
            CHECK(once.share(light) == 1.0);
            light = once.stokes_after(light);
            near(light, expected, 1e-14);
        }
    }
}

TEST_CASE("at Brewster's angle what is reflected is s alone, and beyond it p has turned over",
          "[polarised]") {
    double const n = 1.5, brewster = std::atan(n);
    Sorting const back = sorted_by_dielectric(at(brewster), 1.0, n).back;
    CHECK(back.p < 1e-31);
    near(back.stokes_after(dvec3(0.0)), {1.0, 0.0, 0.0}, 1e-15);
    // 45° light: its reflection lies on the other side of the plane of incidence beyond
    CHECK(sorted_by_dielectric(at(brewster - 0.1), 1.0, n).back.stokes_after({0, 1, 0}).y < 0.0);
    CHECK(sorted_by_dielectric(at(brewster + 0.1), 1.0, n).back.stokes_after({0, 1, 0}).y > 0.0);
}

TEST_CASE("Stokes vectors go as Jones vectors do, at dielectrics and metals, for any light", "[polarised]") {
    Dice dice(5);
    for (int i = 0; i < 2000; ++i) {
        double const angle = dice.between(0.0, 1.55), n1 = dice.between(1.0, 2.0),
                     n2 = dice.between(1.0, 2.0);
        Complex const metal(dice.between(0.05, 3.0), dice.between(0.1, 8.0));
        Complex const s(dice.between(-1.0, 1.0), dice.between(-1.0, 1.0));
        Complex const p(dice.between(-1.0, 1.0), dice.between(-1.0, 1.0));
        double const power = std::norm(s) + std::norm(p);
        auto const same = [&](Sorting const& way, Complex by_s, Complex by_p, double area) {
            double const share = area * (std::norm(by_s * s) + std::norm(by_p * p)) / power;
            CHECK(way.share(stokes_of(s, p)) == Approx(share).epsilon(1e-11).margin(1e-14));
            if (share > 1e-6)
                near(way.stokes_after(stokes_of(s, p)), stokes_of(by_s * s, by_p * p), 1e-9);
        };
        // the textbook's amplitudes, complex beyond the critical angle
        auto const reflected = [&](Complex n) {
            Complex const sine = n1 * std::sin(angle) / n, root = std::sqrt(1.0 - sine * sine);
            Complex const c2 = root.imag() < 0.0 ? -root : root; // it decays beyond
            Complex const c1 = std::cos(angle);
            return std::tuple((n1 * c1 - n * c2) / (n1 * c1 + n * c2),
                              (n * c1 - n1 * c2) / (n * c1 + n1 * c2), 2.0 * n1 * c1 / (n1 * c1 + n * c2),
                              2.0 * n1 * c1 / (n * c1 + n1 * c2), c2);
        };
        auto const [r_s, r_p, t_s, t_p, c2] = reflected(n2);
        SortedWays const clear = sorted_by_dielectric(at(angle), n1, n2);
        same(clear.back, r_s, r_p, 1.0);
        if (clear.through)
            same(*clear.through, t_s, t_p, n2 * c2.real() / (n1 * std::cos(angle)));
        auto const mirror = reflected(metal);
        same(sorted_by_metal(at(angle), n1, metal).back, std::get<0>(mirror), std::get<1>(mirror), 1.0);
    }
}

TEST_CASE("light told by another axis is the same light", "[polarised]") {
    Dice dice(6);
    for (int i = 0; i < 500; ++i) {
        dvec3 const direction =
            normalize(dvec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)));
        dvec3 const axis = perpendicular_to(direction), other = cross(direction, axis);
        double const turn = dice.between(-4.0, 4.0);
        dvec3 const plane = std::cos(turn) * axis + std::sin(turn) * other; // light of this plane
        PolarisedLight const light{axis, {std::cos(2.0 * turn), std::sin(2.0 * turn), 0.0}};
        near(told_by(light, direction, plane).stokes, {1.0, 0.0, 0.0}, 1e-14);
        near(told_by({axis, {0.0, 0.0, 1.0}}, direction, plane).stokes, {0.0, 0.0, 1.0}, 0.0);
    }
}

TEST_CASE("a plate sorts as its two surfaces do, each way to and fro added up", "[polarised]") {
    double const n = 1.6;
    for (double const angle : {0.2, 0.8, 1.3}) {
        SortedWays const plate = sorted_by_plate(at(angle), 1.0, n, 1.2);
        SortedWays const first = sorted_by_dielectric(at(angle), 1.0, n);
        Incidence const within = at(std::asin(std::sin(angle) / n));
        SortedWays const back = sorted_by_dielectric(within, n, 1.0),
                         second = sorted_by_dielectric(within, n, 1.2);
        dvec3 const given(0.3, 0.5, -0.6);
        double share = first.through->share(given), through = 0.0, returned = first.back.share(given);
        dvec3 state = first.through->stokes_after(given), sum(0.0),
              sum_back = returned * first.back.stokes_after(given);
        for (int i = 0; i < 60; ++i) { // to and fro; a surface reflects less than 0.6
            double const out = share * second.through->share(state);
            through += out;
            sum += out * second.through->stokes_after(state);
            share *= second.back.share(state);
            state = second.back.stokes_after(state);
            double const home = share * back.through->share(state);
            returned += home;
            sum_back += home * back.through->stokes_after(state);
            share *= back.back.share(state);
            state = back.back.stokes_after(state);
        }
        CHECK(plate.through->share(given) == Approx(through).epsilon(1e-13));
        CHECK(plate.back.share(given) == Approx(returned).epsilon(1e-13));
        near(plate.through->stokes_after(given), sum / through, 1e-13);
        near(plate.back.stokes_after(given), sum_back / returned, 1e-13);
    }
    CHECK(!sorted_by_plate(at(1.3), 1.5, 1.2, 1.5).through);
}

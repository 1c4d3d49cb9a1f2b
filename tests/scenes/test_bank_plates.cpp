// In: the bank's plane plates. Out: whether light traced through them is shifted, split and absorbed as the
// closed forms say, all reflections between the surfaces counted. Plates lie across z; the light slants
// towards +x.
#include "support/bank.h"
#include "support/bench.h"
#include "support/catch.h"
#include "support/textbook.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

struct Pile {
    std::string medium; // "{n = 1.5}"
    int plates = 1;
    double thickness_mm = 1.0, incidence_deg = 0.0;
};

/// The first plate's first surface is z = 0. Detectors on both sides take all that leaves; they and the
/// plates are wide enough for each path that is not cut.
std::string pile(Pile const& p) {
    double const angle = radians(p.incidence_deg);
    dvec3 const toward(std::sin(angle), 0.0, std::cos(angle));
    std::string experiment = text("[medium]\nglass = ", p.medium,
                                  "\n[[source]]\nname = 'laser'\nbeam = {from_mm = ", -10.0 * toward,
                                  ", toward = ", toward, "}\n");
    double const gap_mm = 0.5;
    for (int i = 0; i < p.plates; ++i)
        experiment += text(
            "[[object]]\nname = 'plate ", i,
            "'\nmedium = 'glass'\nshape = {box = {size_mm = ", dvec3(2000.0, 2000.0, p.thickness_mm),
            "}}\nmove_mm = ", dvec3(0.0, 0.0, 0.5 * p.thickness_mm + i * (p.thickness_mm + gap_mm)), "\n");
    double const behind_mm = p.plates * (p.thickness_mm + gap_mm) + 1.0;
    experiment += text("[[detector]]\nname = 'reflected'\nat_mm = [0, 0, -20]\nfacing = [0, 0, 1]\n",
                       "size_mm = [4000, 4000]\n[[detector]]\nname = 'transmitted'\nat_mm = [0, 0, ",
                       behind_mm, "]\nfacing = [0, 0, -1]\nsize_mm = [4000, 4000]\n");
    return experiment;
}

double power_W(Value const& summary, char const* detector) {
    return number_at(summary, {"detectors", detector, "power_W"});
}
double energy_W(Value const& summary, char const* term) {
    return number_at(summary, {"energy_W", term});
}

} // namespace

TEST_CASE("a plate shifts a ray sideways and a focus along the axis") {
    for (BankCase const& c : bank("plate_displacement")) {
        double const n = c.input("n"), thickness = c.input("thickness_mm");
        auto const path_at = [&](double incidence_deg) {
            Rows const path = direct_path(
                rows_of(bench::run(pile({text("{n = ", n, "}"), 1, thickness, incidence_deg})), 0));
            REQUIRE(path.size() == 3);
            return path;
        };
        // the distance between two parallel lines, the first of which goes through the origin
        auto const shift_mm = [](Rows const& path) {
            return 1e3 * length(cross(path[2].origin, path[0].direction));
        };
        Rows const path = path_at(c.input("incidence_deg"));
        agrees(c, "lateral_displacement_mm", shift_mm(path));
        agrees(c, "opl_inside_mm", 1e3 * (path[1].optical_path - path[0].optical_path));
        CHECK(length(path[2].direction - path[0].direction) < 4e-16);
        // The paraxial shift is the limit of the real one, even in the angle: two angles of 1 and 2 mrad and
        // one step of extrapolation leave its fourth power, 1e-12, and the rounding of millimetres, 1e-15,
        // divided by the angle.
        auto const axial_mm = [&](double angle) {
            return shift_mm(path_at(degrees(angle))) / std::sin(angle);
        };
        agrees(c, "axial_focus_shift_paraxial_mm", (4.0 * axial_mm(1e-3) - axial_mm(2e-3)) / 3.0, 2e-11);
    }
}

// At normal incidence s and p are alike, and the unpolarised trace is exact. At an angle the truth is the
// mean of Stokes' formula for s and for p, the tracer's answer Stokes' formula for the mean of the two at
// each surface: 0.610 instead of 0.709 through four plates at Brewster's angle, 0.474 instead of 0.582
// through ten at 45°. For the truth it must keep them apart. That all of the multiple reflections are
// counted, 20 surfaces deep, is tested here: no branch is lost but those that are cut, so both answers lie
// within the power that was cut.
TEST_CASE("a pile of plates transmits what Stokes' formula says, every reflection counted", "[slow]") {
    for (BankCase const& c : bank("pile_of_plates")) {
        int const plates = static_cast<int>(c.input("plates"));
        double const n = c.input("n"), incidence = c.input("incidence_deg");
        bool const normal = incidence == 0.0;
        double const min_power = normal ? 1e-18 : plates < 10 ? 1e-9 : 1e-6;
        Value const summary = summarise(pile({text("{n = ", n, "}"), plates, 1.0, incidence}),
                                        {"trace.max_depth=1000", text("trace.min_power=", min_power)});
        double const transmitted = power_W(summary, "transmitted"), reflected = power_W(summary, "reflected");
        double const cut = energy_W(summary, "cut");
        CAPTURE(c.id, transmitted, reflected, cut);
        double const r = mean_reflectance(1.0, n, radians(incidence));
        double const both = 1.0 + (2 * plates - 1) * r;
        CHECK(transmitted <= (1.0 - r) / both + 1e-14);
        CHECK(transmitted >= (1.0 - r) / both - cut - 1e-14);
        CHECK(reflected <= 2 * plates * r / both + 1e-14);
        CHECK(reflected >= 2 * plates * r / both - cut - 1e-14);

        CHECK(cut < (normal ? 1e-17 : plates < 10 ? 1e-4 : 0.04));
        if (normal) {
            for (char const* key : {"T_s", "T_p", "T_unpolarised"})
                agrees(c, key, transmitted);
            for (char const* key : {"R_s", "R_p"})
                agrees(c, key, reflected);
        }
    }
}

// Off the normal the first surface's transmittance is exact (test_bank_boundaries.cpp), and so is what the
// direct path loses inside; the sums over all reflections need s and p apart.
TEST_CASE("an absorbing slab transmits, reflects and absorbs what Beer and Lambert say") {
    for (BankCase const& c : bank("beer_lambert_slab")) {
        double const incidence = c.input("incidence_deg");
        std::string const medium =
            text("{n = ", c.input("n"), ", absorption_per_mm = ", c.input("alpha_per_mm"), "}");
        Run const run =
            bench::run(pile({medium, 1, c.input("thickness_mm"), incidence}), {"trace.min_power=1e-18"});
        Segment const& inside = branch(rows_of(run, 0), {Event::refracted});
        agrees(c, "internal_transmittance", inside.power_end / inside.power_start);
        if (incidence != 0.0)
            continue;
        for (std::string const polarisation : {"s", "p"}) {
            agrees(c, "T_" + polarisation, power_W(run.summary, "transmitted"));
            agrees(c, "R_" + polarisation, power_W(run.summary, "reflected"));
            agrees(c, "absorbed_" + polarisation, number_at(run.summary, {"absorbed_W", "plate 0", "bulk"}));
        }
    }
}

// In: the bank's prisms. Out: whether light traced through them turns as the closed forms say.
// A prism stands with its apex edge along z at the top, its base below; the ray comes from the left, in the
// plane z = 0, to the middle of the left face. With the apex angle A the inward normal there points A/2 below
// +x.
#include "support/bank.h"
#include "support/bench.h"
#include "support/catch.h"
#include "support/textbook.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

struct PrismRay {
    dvec3 from, toward;
};

PrismRay ray_into(double apex_deg, double side_mm, double incidence) {
    double const half = radians(0.5 * apex_deg);
    dvec3 const toward(std::cos(incidence - half), std::sin(incidence - half), 0.0);
    return {dvec3(-0.5 * side_mm * std::sin(half), 0.0, 0.0) - 20.0 * toward, toward};
}

std::string prism(std::string const& medium, double apex_deg, double incidence) {
    double const side_mm = 25.0;
    PrismRay const ray = ray_into(apex_deg, side_mm, incidence);
    return text("[[object]]\nname = 'prism'\nmedium = 'glass'\nshape = {prism = {apex_deg = ", apex_deg,
                ", side_mm = ", side_mm, ", length_mm = 25}}\n", "[medium]\nglass = ", medium,
                "\n[[source]]\nname = 'laser'\nlines = ['F', 'd', 'C']\nbeam = {from_mm = ", ray.from,
                ", toward = ", ray.toward, "}\n");
}

std::string prism(double n, double apex_deg, double incidence) {
    return prism(text("{n = ", n, "}"), apex_deg, incidence);
}

/// That of the light that goes straight through: three segments, in by the left face and out by the right.
double deviation_deg(Run const& run, std::uint64_t ray) {
    Rows const path = direct_path(rows_of(run, ray));
    REQUIRE(path.size() == 3);
    CHECK(surface_at_end(run, path[0]) == "prism.left");
    CHECK(surface_at_end(run, path[1]) == "prism.right");
    return angle_deg(path[0].direction, path[2].direction);
}

} // namespace

TEST_CASE("a prism at minimum deviation deviates as the symmetric path says") {
    for (BankCase const& c : bank("prism_min_deviation")) {
        double const apex = c.input("apex_deg"), incidence = radians(c.output("incidence_deg"));
        Run const run = bench::run(prism(c.input("n"), apex, incidence));
        agrees(c, "deviation_deg", deviation_deg(run, 0));
        // the path inside is perpendicular to the bisector of the apex
        CHECK(std::abs(direct_path(rows_of(run, 0))[1].direction.y) < 1e-15);
        for (double const other : {incidence - 0.01, incidence + 0.01})
            CHECK(deviation_deg(bench::run(prism(c.input("n"), apex, other)), 0) > c.output("deviation_deg"));
    }
}

// The products for s and p alone need them kept apart on the way. Without, a ray is unpolarised at each
// surface, so it carries the product of the means. The textbook's shares are tied to the bank by their
// products, the tracer's power to the textbook's means.
TEST_CASE("a prism away from minimum deviation refracts, or reflects all at its second face") {
    for (BankCase const& c : bank("prism_general")) {
        double const n = c.input("n"), apex = c.input("apex_deg");
        double const incidence = radians(c.input("incidence_deg"));
        Run const run = bench::run(prism(n, apex, incidence));
        Rows const path = direct_path(rows_of(run, 0));
        REQUIRE(path.size() >= 3);
        CHECK(surface_at_end(run, path[1]) == "prism.right");
        double const half = radians(0.5 * apex);
        dvec3 const right_normal(std::cos(half), std::sin(half), 0.0);
        double const inside = angle_deg(path[1].direction, right_normal);
        if (std::get<bool>(c.outputs.find("tir_at_second_face")->data)) {
            agrees(c, "inside_incidence_deg", inside);
            CHECK(path[1].ended == Event::total_internal);
            CHECK(path[2].born == Event::total_internal);
            CHECK(path[2].power_start == path[1].power_end);
            continue;
        }
        agrees(c, "exit_angle_deg", angle_deg(path[2].direction, right_normal));
        agrees(c, "deviation_deg", deviation_deg(run, 0));
        auto const [s1, p1] = reflectances(1.0, n, incidence);
        auto const [s2, p2] = reflectances(n, 1.0, radians(inside));
        agrees(c, "direct_transmittance_s", (1.0 - s1) * (1.0 - s2));
        agrees(c, "direct_transmittance_p", (1.0 - p1) * (1.0 - p2));
        double const after_one = 1.0 - 0.5 * (s1 + p1);
        double const emitted = path[0].power_start;
        CHECK(std::abs(path[1].power_start / emitted - after_one) < c.tolerance);
        CHECK(std::abs(path[2].power_start / emitted - after_one * (1.0 - 0.5 * (s2 + p2))) < c.tolerance);
    }
}

TEST_CASE("Sellmeier's formula gives the index, and a refraction gives it back") {
    for (BankCase const& c : bank("sellmeier")) {
        auto const list = [&](char const* key) {
            std::string digits;
            for (Value const& value : std::get<Array>(c.input_value(key).data))
                digits += text(digits.empty() ? "" : ", ", decimal(value));
            return "[" + digits + "]";
        };
        std::string const medium = "{sellmeier = {B = " + list("B") + ", C_um2 = " + list("C_um2") + "}}";
        double const incidence = radians(50.0);
        Run const run = bench::run(prism(medium, 60.0, incidence));
        double n[3];
        int line = 0;
        for (char const* key : {"n_F", "n_d", "n_C"}) {
            double const wavelength_nm = run.names.wavelengths_m[static_cast<std::size_t>(line)] * 1e9;
            n[line] = index_of(run, "glass", wavelength_nm);
            agrees(c, key, n[line]);
            // the left face's inward normal is 30° below +x; four roundings of 1.1e-16 in two sines of about
            // 0.5, times n/sin: below 2e-15
            dvec3 const normal(std::cos(radians(30.0)), -std::sin(radians(30.0)), 0.0);
            Rows const path = direct_path(rows_of(run, static_cast<std::uint64_t>(line)));
            double const sine = length(cross(path[0].direction, normal));
            agrees(c, key, sine / length(cross(path[1].direction, normal)));
            ++line;
        }
        // V = (n_d − 1)/(n_F − n_C): an ulp of n, 2.2e-16, in a difference of 0.008 or more, makes 2.8e-14 of
        // 64
        agrees(c, "abbe_Vd", (n[1] - 1.0) / (n[0] - n[2]),
               2.0 * 2.2e-16 / (n[0] - n[2]) * c.output("abbe_Vd"));
    }
}

TEST_CASE("a prism of the catalogue's SF10 disperses as its formula says") {
    for (BankCase const& c : bank("dispersing_prism")) {
        Run const run = bench::run(prism("{glass = 'SF10', absorption = false}", c.input("apex_deg"),
                                         radians(c.output("incidence_deg"))));
        agrees(c, "deviation_F_deg", deviation_deg(run, 0));
        agrees(c, "deviation_d_deg", deviation_deg(run, 1));
        agrees(c, "deviation_C_deg", deviation_deg(run, 2));
    }
}

// Cut off above the ray, a Dove prism is an isosceles prism with an apex of 90°.
TEST_CASE("a Dove prism lets a ray out parallel to itself, upside down") {
    for (BankCase const& c : bank("dove_prism")) {
        double const base = c.input("base_length_mm"), height = c.input("ray_height_mm");
        Run const run = bench::run(
            text("[medium]\nglass = {n = ", c.input("n"), "}\n[[object]]\nname = 'dove'\nmedium = 'glass'\n",
                 "shape = {prism = {apex_deg = 90, side_mm = ", base / std::numbers::sqrt2,
                 ", length_mm = 20}}\n", "move_mm = ", dvec3(0.5 * base, 0.25 * base, 0.0),
                 "\n[[source]]\nname = 'laser'\nbeam = {from_mm = ", dvec3(-10.0, height, 0.0),
                 ", toward = [1, 0, 0]}\n"));
        Rows const path = direct_path(rows_of(run, 0));
        REQUIRE(path.size() == 4);
        CHECK(path[1].ended == Event::total_internal);
        CHECK(surface_at_end(run, path[1]) == "dove.base");
        agrees(c, "tir_point_x_mm", 1e3 * end_of(path[1]).x);
        agrees(c, "exit_x_mm", 1e3 * path[3].origin.x);
        agrees(c, "exit_y_mm", 1e3 * path[3].origin.y);
        agrees(c, "exit_dir_y", path[3].direction.y);
        agrees(c, "opl_inside_mm", 1e3 * (path[2].optical_path - path[0].optical_path));
    }
}

// Entry and exit face stand at right angles: two sides of a box. The face between them, whose normal is 75°
// from the entry face's, is where a box of air, of higher priority, cuts the glass off.
TEST_CASE("a Pellin-Broca prism deviates by a right angle") {
    for (BankCase const& c : bank("pellin_broca")) {
        double const incidence = radians(c.output("incidence_for_90deg_deg"));
        dvec3 const toward(std::cos(incidence), std::sin(incidence), 0.0);
        dvec3 const cut(std::cos(radians(75.0)), std::sin(radians(75.0)), 0.0);
        double const cut_at_mm = 16.7; // from the corner of entry and exit face
        Run const run = bench::run(
            text("[medium]\nglass = {n = ", c.input("n"), "}\n[[object]]\nname = 'prism'\nmedium = 'glass'\n",
                 "shape = {box = {size_mm = [40, 40, 20]}}\nmove_mm = [20, 20, 0]\n",
                 "[[object]]\nname = 'cut'\nmedium = 'air'\npriority = 1\nshape = {box = {size_mm = [200, "
                 "100, 40]}}\n",
                 "turn_deg = [0, 0, -15]\nmove_mm = ", (cut_at_mm + 50.0) * cut,
                 "\n[[source]]\nname = 'laser'\nbeam = {from_mm = ", dvec3(0.0, 10.0, 0.0) - 5.0 * toward,
                 ", toward = ", toward, "}\n"));
        Rows const path = direct_path(rows_of(run, 0));
        REQUIRE(path.size() == 4);
        CHECK(surface_at_end(run, path[0]) == "prism.left");
        CHECK(path[1].ended == Event::total_internal);
        CHECK(surface_at_end(run, path[1]) == "cut.bottom");
        CHECK(surface_at_end(run, path[2]) == "prism.bottom");
        agrees(c, "deviation_deg", angle_deg(path[0].direction, path[3].direction));
    }
}

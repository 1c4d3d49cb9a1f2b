// In: the bank's single boundaries. Out: whether light traced to one reflects, refracts and is absorbed as
// Fresnel says. One surface is where unpolarised light is exact: the mean of s and p.
#include "support/bank.h"
#include "support/bench.h"
#include "support/catch.h"
#include "support/textbook.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

dvec3 slanting(double incidence_deg) {
    return {std::sin(radians(incidence_deg)), 0.0, std::cos(radians(incidence_deg))};
}

/// A laser aimed at the origin, in the plane z = 0 between medium `first`, where it starts, and `second`.
/// At 89.9° the light runs along it for hundreds of times its distance: hence the size.
std::string boundary(double first, double second, std::string const& lasers) {
    return text(
        "surroundings = 'first'\n[medium]\nfirst = {n = ", first, "}\nsecond = {n = ", second,
        "}\n[[object]]\nname = 'block'\nmedium = 'second'\nshape = {box = {size_mm = [400, 400, 100]}}\n",
        "move_mm = [0, 0, 50]\n", lasers);
}

std::string laser(double incidence_deg, char const* name = "laser") {
    dvec3 const toward = slanting(incidence_deg);
    return text("[[source]]\nname = '", name, "'\nbeam = {from_mm = ", -20.0 * toward, ", toward = ", toward,
                "}\n");
}

double power_of(Rows const& rows, Event birth) {
    return branch(rows, {birth}).power_start / rows.front().power_end;
}

} // namespace

TEST_CASE("a boundary of two dielectrics reflects and refracts as Fresnel and Snell say") {
    for (BankCase const& c : bank("fresnel_dielectric")) {
        double const incidence = c.input("incidence_deg");
        Rows const rows = rows_of(bench::run(boundary(c.input("n1"), c.input("n2"), laser(incidence))), 0);
        if (c.output("R_s") == 1.0) { // total: the phases need polarised tracing
            CHECK(rows.front().ended == Event::total_internal);
            CHECK(power_of(rows, Event::total_internal) == 1.0);
            CHECK(length(rows[1].direction - slanting(180.0 - incidence)) < 1e-15);
            continue;
        }
        INFO(c.id);
        CHECK(std::abs(power_of(rows, Event::reflected) - 0.5 * (c.output("R_s") + c.output("R_p"))) <
              c.tolerance);
        CHECK(std::abs(power_of(rows, Event::refracted) - 0.5 * (c.output("T_s") + c.output("T_p"))) <
              c.tolerance);
        agrees(c, "refraction_deg", angle_deg(branch(rows, {Event::refracted}).direction, dvec3(0, 0, 1)));
        CHECK(length(branch(rows, {Event::reflected}).direction - slanting(180.0 - incidence)) < 1e-15);
    }
}

TEST_CASE("Brewster's and the critical angle are where they should be") {
    for (BankCase const& c : bank("special_angles")) {
        double const n1 = c.input("n1"), n2 = c.input("n2"), brewster = c.output("brewster_deg");
        Run const run = bench::run(boundary(n1, n2, laser(0.0) + laser(brewster, "at Brewster")));
        agrees(c, "R_normal", power_of(rows_of(run, 0), Event::reflected));
        // p light is not reflected at Brewster's angle: the mean is half of s
        double const at_brewster = power_of(rows_of(run, 1), Event::reflected);
        agrees(c, "R_s_at_brewster", 2.0 * at_brewster);
        // and there what is reflected is perpendicular to what is refracted
        CHECK(std::abs(dot(branch(rows_of(run, 1), {Event::reflected}).direction,
                           branch(rows_of(run, 1), {Event::refracted}).direction)) < 1e-15);
        if (!c.outputs.find("critical_deg"))
            continue;
        double const critical = c.output("critical_deg");
        Run const near = bench::run(
            boundary(n1, n2, laser(critical - c.tolerance, "below") + laser(critical + c.tolerance, "above")),
            {"trace.min_power=0"});
        CHECK(rows_of(near, 0).front().ended == Event::refracted);
        CHECK(rows_of(near, 1).front().ended == Event::total_internal);
    }
}

TEST_CASE("a metal mirror reflects and absorbs as its complex index says") {
    for (BankCase const& c : bank("fresnel_metal")) {
        Run const run = bench::run(text("[surface]\nmetal = {n = ", c.input("n"), ", k = ", c.input("k"),
                                        "}\n[[object]]\nname = 'mirror'\nsurface = 'metal'\n",
                                        "shape = {rectangle = {size_mm = [10, 10]}}\n") +
                                   laser(c.input("incidence_deg")));
        INFO(c.id);
        double const absorbed = number_at(run.summary, {"absorbed_W", "mirror", "surface", "mirror"});
        double const reflected = power_of(rows_of(run, 0), Event::reflected);
        CHECK(std::abs(reflected - 0.5 * (c.output("R_s") + c.output("R_p"))) < c.tolerance);
        CHECK(std::abs(absorbed - 0.5 * (c.output("A_s") + c.output("A_p"))) < c.tolerance);
    }
}

namespace {

std::string lambertian_at(double z_mm, std::uint64_t rays) {
    return text("[[source]]\nname = 'lamp'\nlambertian = {at_mm = ", dvec3(0.0, 0.0, z_mm),
                ", toward = [0, 0, 1], size_mm = [1, 1], rays = ", rays, "}\n");
}

/// A block of glass whose faces are black but for the front, z = 0 to z = 1000 mm … or from −1000 to 0.
std::string black_block(double n, char const* clear, double middle_mm) {
    std::string faces;
    for (std::string const face : {"left", "right", "bottom", "top", "back", "front"})
        if (face != clear)
            faces += face + " = 'black', ";
    return text("[medium]\nglass = {n = ", n,
                "}\n[surface]\nblack = {absorb = true}\n[[object]]\nname = 'block'\n",
                "medium = 'glass'\nshape = {box = {size_mm = [1000, 1000, 100]}}\nfaces = {",
                faces.substr(0, faces.size() - 2), "}\nmove_mm = ", dvec3(0.0, 0.0, middle_mm), "\n");
}

/// The mean of `share` over rays that are independent draws, and four standard errors of it.
struct Sampled {
    double mean, four_sigma;
};
Sampled shares_at_first_surface(Run const& run, Event birth) {
    double sum = 0.0, squares = 0.0, rays = 0.0;
    for (Segment const& segment : run.segments) {
        if (segment.depth == 0)
            rays += 1.0;
        if (segment.depth != 1 || segment.born != birth)
            continue;
        double const emitted = number_at(run.summary, {"energy_W", "emitted"});
        double const share = segment.power_start / emitted;
        sum += share;
        squares += share * share;
    }
    double const variance = squares * rays - sum * sum; // of share · rays
    return {sum, 4.0 * std::sqrt(variance / rays)};
}

} // namespace

// Monte Carlo: the tolerance is four standard errors, from the sample's own variance; some 2e-3 with 40 000
// rays.
TEST_CASE("diffuse light is reflected at a flat face as the integral over Fresnel's shares says", "[slow]") {
    for (BankCase const& c : bank("diffuse_fresnel")) {
        double const n = c.input("n");
        Run const outside =
            bench::run(black_block(n, "back", 50.0) + lambertian_at(-1e-3, 40000), {"trace.max_depth=2"});
        Sampled const external = shares_at_first_surface(outside, Event::reflected);
        agrees(c, "hemispherical_R_external", external.mean, external.four_sigma);
        // inside, what is not refracted is reflected, by Fresnel or totally
        Run const inside =
            bench::run(black_block(n, "front", -50.0) + lambertian_at(-1e-3, 40000), {"trace.max_depth=2"});
        Sampled const through = shares_at_first_surface(inside, Event::refracted);
        agrees(c, "hemispherical_R_internal", 1.0 - through.mean, through.four_sigma);
    }
}

// The share of directions is known before tracing; that none of the trapped ones is ever let out, and that
// each other one is, the trace must show. Standard errors as for independent draws: the source's
// low-discrepancy points do better.
TEST_CASE("a glass cube traps light for ever outside its six escape cones", "[slow]") {
    for (BankCase const& c : bank("diffuse_fresnel")) {
        double const rays = 8192.0;
        Run const run = bench::run(
            text("[medium]\nglass = {n = ", c.input("n"), "}\n[[object]]\nname = 'cube'\nmedium = 'glass'\n",
                 "shape = {box = {size_mm = [10, 10, 10]}}\n[[source]]\nname = 'lamp'\n",
                 "point = {at_mm = [0.1, 0.2, 0.3], rays = ", rays, "}\n"),
            {"trace.max_depth=4", "trace.min_power=0"});
        double trapped = 0.0, out_by_front = 0.0;
        double const cosine = std::sqrt(1.0 - std::pow(c.input("n"), -2.0));
        for (std::uint64_t ray = 0; ray < static_cast<std::uint64_t>(rays); ++ray) {
            Rows const rows = rows_of(run, ray);
            bool leaves = false;
            for (Segment const& row : rows)
                leaves = leaves || row.ended == Event::refracted;
            trapped += leaves ? 0.0 : 1.0;
            out_by_front += rows.front().direction.z > cosine ? 1.0 : 0.0;
        }
        double const free_share = c.output("isotropic_trapped_fraction_cube");
        double const cone = c.output("isotropic_escape_cone_fraction_one_face");
        agrees(c, "isotropic_trapped_fraction_cube", trapped / rays,
               4.0 * std::sqrt(free_share * (1.0 - free_share) / rays));
        agrees(c, "isotropic_escape_cone_fraction_one_face", out_by_front / rays,
               4.0 * std::sqrt(cone * (1.0 - cone) / rays));
    }
}

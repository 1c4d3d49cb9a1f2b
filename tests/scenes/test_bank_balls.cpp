// In: the bank's balls and drops. Out: whether light traced through a sphere leaves where, whither and with
// what power the closed forms say. The light comes along +z at a height on x; the sphere's centre is the
// origin.
#include "support/bank.h"
#include "support/bench.h"
#include "support/catch.h"
#include "support/textbook.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

std::string ball(double n, double radius_mm, std::string const& rays) {
    return text("[medium]\nglass = {n = ", n, "}\n[[object]]\nname = 'ball'\nmedium = 'glass'\n",
                "shape = {sphere = {radius_mm = ", radius_mm, "}}\n[[source]]\nname = 'rays'\nrays = [", rays,
                "]\n");
}

std::string ray_at(double height_mm, double start_mm) {
    return text("[", height_mm, ", 0, ", start_mm, ", 0, 0, 1], ");
}

/// In, then reflected inside so many times: by Fresnel, never totally.
std::vector<Event> inside_after(int reflections) {
    std::vector<Event> births(static_cast<std::size_t>(reflections) + 1, Event::reflected);
    births.front() = Event::refracted;
    return births;
}

/// The light that leaves after so many reflections inside.
Segment order(Rows const& rows, int reflections) {
    std::vector<Event> births = inside_after(reflections);
    births.push_back(Event::refracted);
    return branch(rows, births);
}

/// Where a line meets the plane x = 0.
double axis_crossing_mm(Segment const& segment) {
    return 1e3 * (segment.origin.z - segment.origin.x * segment.direction.z / segment.direction.x);
}

} // namespace

TEST_CASE("a ball lens focuses with the aberration of the closed form") {
    for (BankCase const& c : bank("ball_lens")) {
        double const radius = c.input("radius_mm"), height = c.input("ray_height_mm");
        Run const run = bench::run(ball(c.input("n"), radius, ray_at(height, -2.0 * radius)));
        Rows const path = direct_path(rows_of(run, 0));
        REQUIRE(path.size() == 3);
        Segment const& out = path[2];
        agrees(c, "axis_crossing_from_centre_mm", axis_crossing_mm(out));
        agrees(c, "longitudinal_aberration_mm", axis_crossing_mm(out) - c.output("efl_mm"));
        agrees(c, "deviation_deg", angle_deg(path[0].direction, out.direction));
        agrees(c, "opl_inside_mm", 1e3 * (path[1].optical_path - path[0].optical_path));
        agrees(c, "exit_x_mm", 1e3 * out.origin.x);
        agrees(c, "exit_z_mm", 1e3 * out.origin.z);
        agrees(c, "dir_x", out.direction.x);
        agrees(c, "dir_z", out.direction.z);
        // Both surfaces are met at the same pair of angles, so each transmits the root of the bank's product.
        // After one of them the mean of s and p is exact; after two the tracer has its square, the truth the
        // mean of squares.
        double const one = 0.5 * (std::sqrt(c.output("T_direct_s")) + std::sqrt(c.output("T_direct_p")));
        CHECK(std::abs(path[1].power_start - one) < c.tolerance);
        CHECK(std::abs(out.power_start - one * one) < c.tolerance);
    }
}

TEST_CASE("near the axis a ball lens has the focal length of the closed form") {
    for (BankCase const& c : bank("ball_lens")) {
        double const radius = c.input("radius_mm"), small = 1e-4 * radius;
        Run const run = bench::run(ball(c.input("n"), radius, ray_at(small, -2.0 * radius)));
        double const crossing = axis_crossing_mm(direct_path(rows_of(run, 0))[2]);
        // the aberration grows with the square of the height and is of the order of the radius at its rim
        agrees(c, "efl_mm", crossing, 1e-8 * radius);
        agrees(c, "bfl_mm", crossing - radius, 1e-8 * radius);
    }
}

TEST_CASE("a drop's rainbow stands at the angle of Descartes") {
    for (BankCase const& c : bank("rainbow_angle")) {
        double const b = c.output("impact_parameter");
        int const k = static_cast<int>(c.input("internal_reflections"));
        Run const run = bench::run(
            ball(c.input("n"), 1.0, ray_at(b, -5.0) + ray_at(b - 0.01, -5.0) + ray_at(b + 0.01, -5.0)));
        // measured from −z, the direction of the antisolar point, to the side that the light leaves to
        auto const from_antisolar = [&](std::uint64_t ray) {
            dvec3 const d = order(rows_of(run, ray), k).direction;
            return degrees(std::atan2(k == 1 ? -d.x : d.x, -d.z));
        };
        double const bow = from_antisolar(0);
        agrees(c, "rainbow_angle_from_antisolar_deg", bow);
        agrees(c, "deviation_deg", k == 1 ? 180.0 - bow : 180.0 + bow);
        for (std::uint64_t const neighbour : {1U, 2U}) // all light of this order is on one side of the bow
            CHECK((k == 1 ? from_antisolar(neighbour) < bow : from_antisolar(neighbour) > bow));
        dvec3 const normal = 1e3 * end_of(rows_of(run, 0)[0]); // of the unit sphere
        agrees(c, "incidence_deg", angle_deg(normal, dvec3(0, 0, -1)));
    }
}

// s and p share the light's power differently from the second surface on. What is exact without keeping them
// apart: on the axis, all orders; off it, order 0, the mean. What the tracer holds for the others is told
// too: the closed form with the mean of s and p at each surface. All directions are exact.
TEST_CASE("a drop's orders leave with their deflections, and on the axis with their powers") {
    for (BankCase const& c : bank("drop_order_intensities")) {
        double const b = c.input("impact_parameter");
        Run const run = bench::run(ball(c.input("n"), 1.0, ray_at(b, -5.0)), {"trace.min_power=0"});
        Rows const rows = rows_of(run, 0);
        double const r = 0.5 * (c.output("I0_s") + c.output("I0_p"));
        for (int p = 0; p <= 6; ++p) {
            Segment const& out = p == 0 ? branch(rows, {Event::reflected}) : order(rows, p - 1);
            std::string const name = std::to_string(p);
            // order 0 leaves upwards, the others are turned downwards; a deflection of 700° is known to
            // 1e-13° as a double, and its cosine to 2e-15
            double const turn = radians(c.output("deflection" + name + "_deg"));
            INFO(c.id << ": order " << p);
            CHECK(std::abs(out.direction.x - (p == 0 ? std::sin(turn) : -std::sin(turn))) < 1e-14);
            CHECK(std::abs(out.direction.z - std::cos(turn)) < 1e-14);
            if (b == 0.0) {
                agrees(c, "I" + name + "_s", out.power_start);
                agrees(c, "I" + name + "_p", out.power_start);
            }
            CHECK(std::abs(out.power_start - (p == 0 ? r : (1.0 - r) * (1.0 - r) * std::pow(r, p - 1))) <
                  c.tolerance);
        }
        double const residual = branch(rows, inside_after(6)).power_start;
        CHECK(std::abs(residual - (1.0 - r) * std::pow(r, 6)) < c.tolerance);
        if (b == 0.0) {
            agrees(c, "residual_after_p6_s", residual);
            agrees(c, "residual_after_p6_p", residual);
        }
    }
}

TEST_CASE("light from the aplanatic point of a ball seems to come from one point") {
    for (BankCase const& c : bank("aplanatic_sphere")) {
        double const radius = c.input("R_mm"), object = -c.output("object_from_centre_mm");
        std::string rays;
        auto const& angles = std::get<Array>(c.input_value("ray_angles_to_plus_z_deg").data);
        for (Value const& angle : angles)
            rays += text("[0, 0, ", object, ", ", std::sin(radians(decimal(angle))), ", 0, ",
                         std::cos(radians(decimal(angle))), "], ");
        Run const run = bench::run(ball(c.input("n"), radius, rays));
        for (std::size_t i = 0; i < angles.size(); ++i) {
            Segment const& out = branch(rows_of(run, i), {Event::refracted});
            std::string const ray = "ray" + std::to_string(i);
            agrees(c, ray + "_axis_cross_z_mm", axis_crossing_mm(out));
            agrees(c, ray + "_dirx", out.direction.x);
            agrees(c, ray + "_dirz", out.direction.z);
            agrees(c, "virtual_image_from_centre_mm", -axis_crossing_mm(out));
        }
    }
}

// The reflected share alone: the orders that go through need s and p apart. The integral over the beam's disc
// is one over b²: 24 nodes of Gauss suffice, since the integrand's nearest singularity, b = R, is far enough
// from the rim at 0.9 R that the remainder falls as 2.5^−48.
TEST_CASE("a ball reflects the closed integral's share of a wide beam") {
    for (BankCase const& c : bank("ball_flux_orders")) {
        double const rim = c.input("beam_radius_over_R");
        std::string rays;
        for (Node const& node : gauss_legendre(24))
            rays += text("[", rim * std::sqrt(node.x), ", 0, -5, 0, 0, 1, ", node.weight, "], ");
        Run const run = bench::run(ball(c.input("n"), 1.0, rays));
        double reflected = 0.0;
        for (Segment const& segment : run.segments)
            if (segment.born == Event::reflected && segment.depth == 1)
                reflected += segment.power_start;
        agrees(c, "flux_reflected_unpol", reflected);
    }
}

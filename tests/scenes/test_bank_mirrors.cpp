// In: the bank's mirrors and its light pipe. Out: whether rays that are reflected, up to 13 076 times, end
// where the method of images says.
#include "support/bank.h"
#include "support/bench.h"
#include "support/catch.h"
#include "support/textbook.h"

#include <algorithm>

using namespace sahl;
using namespace sahl::bench;

namespace {

std::string ideal_mirror() {
    return "[surface]\nideal = {reflect = 1, transmit = 0}\n";
}

/// A square mirror with its middle at `at` and the given unit normal; `along` is a unit vector in it.
std::string mirror(std::string const& name, double size_mm, dvec3 const& at_mm, dvec3 const& normal,
                   dvec3 const& along) {
    dvec3 const other = cross(normal, along);
    std::string matrix;
    for (dvec3 const& column : {along, other, normal})
        matrix += text(column.x, ", ", column.y, ", ", column.z, ", 0, ");
    matrix += text(at_mm.x, ", ", at_mm.y, ", ", at_mm.z, ", 1");
    return text("[[object]]\nname = '", name, "'\nsurface = 'ideal'\nshape = {rectangle = {size_mm = [",
                size_mm, ", ", size_mm, "]}}\nmatrix = [", matrix, "]\n");
}

std::string one_ray(dvec3 const& from, dvec3 const& toward) {
    return text("[[source]]\nname = 'laser'\nbeam = {from_mm = ", from, ", toward = ", toward, "}\n");
}

} // namespace

// A rod of n = 1.5, where all angles at its walls are above the critical one, 41.8°: 55.9° and 66.9°. Each
// reflection stores its place, rounded by up to half an ulp of its distance along the rod: 9e-13 mm at 10 m.
// Steps are alike, so roundings may be too, and add up: 1.2e-8 mm at worst over 13 076 of them. Directions
// keep their digits: reflection at a wall turns one sign.
TEST_CASE("a light pipe reflects totally thousands of times and loses neither place nor power") {
    for (BankCase const& c : bank("mirror_pipe")) {
        double const length_mm = c.input("length");
        auto const triple = [&](char const* key) {
            auto const& list = std::get<Array>(c.input_value(key).data);
            return dvec3(decimal(list[0]), decimal(list[1]), decimal(list[2]));
        };
        Run const run =
            bench::run(text("[medium]\nglass = {n = 1.5}\n[[object]]\nname = 'rod'\nmedium = 'glass'\nshape "
                            "= {box = {size_mm = ",
                            dvec3(c.input("width"), c.input("height"), length_mm + 2.0),
                            "}}\nmove_mm = ", dvec3(0.0, 0.0, 0.5 * length_mm),
                            "\n[[detector]]\nname = 'end'\nfacing = [0, 0, -1]\nsize_mm = [2, 2]\n",
                            "at_mm = ", dvec3(0.0, 0.0, length_mm), "\n") +
                           one_ray(triple("start"), triple("direction")),
                       {"trace.max_depth=20000"});
        double x = 0.0, y = 0.0;
        long double path_mm = 0.0L; // that the sum adds no rounding of its own
        for (Segment const& segment : run.segments) {
            std::string const face = surface_at_end(run, segment);
            x += face == "rod.left" || face == "rod.right" ? 1.0 : 0.0;
            y += face == "rod.bottom" || face == "rod.top" ? 1.0 : 0.0;
            path_mm += 1e3L * segment.length;
        }
        Segment const& last = run.segments.back();
        REQUIRE(last.ended == Event::detected);
        CHECK(x == c.output("bounces_x"));
        CHECK(y == c.output("bounces_y"));
        CHECK(number_at(run.summary, {"events", "total_internal"}) == x + y);
        agrees(c, "x_end", 1e3 * end_of(last).x);
        agrees(c, "y_end", 1e3 * end_of(last).y);
        agrees(c, "dirx_end", last.direction.x);
        agrees(c, "diry_end", last.direction.y);
        agrees(c, "dirz_end", last.direction.z);
        double const half_ulp = 0.5 * 2.2e-16 * length_mm;
        double const path_tolerance = std::max(c.tolerance, (x + y) * half_ulp / c.output("dirz_end"));
        agrees(c, "path", static_cast<double>(path_mm), path_tolerance);
        agrees(c, "path", 1e3 * last.optical_path / 1.5, path_tolerance);
        CHECK(last.power_end == run.segments.front().power_start);
    }
}

TEST_CASE("two mirrors turn a ray by twice their angle, whatever the incidence") {
    for (BankCase const& c : bank("two_mirror_wedge")) {
        double const wedge = radians(c.input("wedge_deg"));
        // one mirror lies in the plane y = 0, the other rises from the origin at the wedge's angle
        dvec3 const up(std::cos(wedge), std::sin(wedge), 0.0);
        dvec3 const down(std::sin(wedge), -std::cos(wedge), 0.0);
        for (double const incidence_deg : {c.input("incidence_deg"), 5.0, 30.0}) {
            double const incidence = radians(incidence_deg);
            dvec3 const toward(-std::sin(incidence), -std::cos(incidence), 0.0);
            Run const run = bench::run(
                ideal_mirror() + mirror("flat", 2.0, dvec3(2, 0, 0), dvec3(0, 1, 0), dvec3(1, 0, 0)) +
                mirror("risen", 2.0, 2.0 * up, down, up) + one_ray(dvec3(2, 0, 0) - 1.5 * toward, toward));
            REQUIRE(run.segments.size() == 3);
            CHECK(surface_at_end(run, run.segments[0]) == "flat");
            CHECK(surface_at_end(run, run.segments[1]) == "risen");
            agrees(c, "deviation_deg", angle_deg(toward, run.segments[2].direction));
        }
    }
}

// The three mirrors go through the origin; the ray meets first that whose coordinate is least.
TEST_CASE("a corner cube returns every ray antiparallel, and its errors turn it as they should") {
    for (BankCase const& c : bank("corner_cube")) {
        double e[3];
        for (std::size_t i = 0; i < 3; ++i)
            e[i] = radians(decimal(std::get<Array>(c.input_value("errors_arcsec").data)[i]) / 3600.0);
        dvec3 const axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        dvec3 const normals[3] = {normalize(dvec3(1, e[0], 0)), normalize(dvec3(0, 1, e[1])),
                                  normalize(dvec3(e[2], 0, 1))};
        dvec3 const toward = normalize(dvec3(-1, -1, -1));
        std::string mirrors = ideal_mirror();
        for (std::size_t i = 0; i < 3; ++i)
            mirrors += mirror(text("m", i), 100.0, dvec3(0.0), normals[i],
                              perpendicular_to(normals[i], axes[(i + 1) % 3]));
        struct Order {
            char const* name;
            dvec3 from;
        };
        for (Order const& order :
             {Order{"012", {11, 12, 13}}, Order{"210", {13, 12, 11}}, Order{"102", {12, 11, 13}}}) {
            Run const run = bench::run(mirrors + one_ray(order.from, toward));
            REQUIRE(run.segments.size() == 4);
            for (std::size_t i = 0; i < 3; ++i)
                CHECK(surface_at_end(run, run.segments[i]) == text("m", order.name[i]));
            dvec3 const back = run.segments[3].direction;
            std::string const key = std::string("order_") + order.name + "_";
            agrees(c, key + "dirx", back.x);
            agrees(c, key + "diry", back.y);
            agrees(c, key + "dirz", back.z);
            // the bank's 1e-13 stands for the components; a direction that is rounded to 1.1e-16 in each of
            // them is known to some 2e-16 rad a reflection, and 1 rad is 206 265 arc seconds: 1.2e-10 for
            // three
            agrees(c, key + "return_error_arcsec", 3600.0 * angle_deg(back, -toward), 1.2e-10);
        }
    }
}

// There is no concave mirror among the shapes, but the inside of a silvered ball of air is one.
TEST_CASE("a concave spherical mirror has the aberration and the caustic of the closed form") {
    for (BankCase const& c : bank("spherical_mirror")) {
        double const radius = c.input("R_mm"), height = c.input("ray_height_mm"), step = 1e-3;
        std::string rays;
        for (double const h : {height, height - step, height + step})
            rays += text("[", h, ", 0, 0, 0, 0, 1], ");
        Run const run =
            bench::run(ideal_mirror() + text("[[object]]\nname = 'ball'\nmedium = 'air'\nsurface = 'ideal'\n",
                                             "shape = {sphere = {radius_mm = ", radius,
                                             "}}\n[[source]]\nname = 'rays'\nrays = [", rays, "]\n"),
                       {"trace.max_depth=1"});
        auto const reflected = [&](std::uint64_t ray) {
            return branch(rows_of(run, ray), {Event::reflected});
        };
        Segment const ray = reflected(0);
        double const crossing = 1e3 * (ray.origin.z - ray.origin.x * ray.direction.z / ray.direction.x);
        agrees(c, "axis_crossing_from_centre_mm", crossing);
        agrees(c, "longitudinal_aberration_mm", crossing - 0.5 * radius);
        // The caustic is where neighbours cross. Two rays at ± 1e-3 mm do so within (1e-3)²/R of it, about
        // 1e-7 mm times the caustic's curvature terms of order 1; rounding of 1e-14 mm over their angle of
        // 1e-5 gives 1e-9.
        Segment const a = reflected(1), b = reflected(2);
        double const det = a.direction.x * b.direction.z - a.direction.z * b.direction.x;
        dvec3 const apart = b.origin - a.origin;
        double const t = (apart.x * b.direction.z - apart.z * b.direction.x) / det;
        dvec3 const caustic = 1e3 * (a.origin + t * a.direction);
        agrees(c, "caustic_x_mm", caustic.x, 1e-6);
        agrees(c, "caustic_z_from_centre_mm", caustic.z, 1e-6);
    }
}

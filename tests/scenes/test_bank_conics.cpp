// In: the bank's conics of revolution, and lenses and mirrors of conics. Out: whether they focus as Descartes
// and the definitions of parabola and ellipse say.
#include "support/bank.h"
#include "support/bench.h"
#include "support/catch.h"
#include "support/textbook.h"

#include <algorithm>

using namespace sahl;
using namespace sahl::bench;

namespace {

std::string mirror(double radius_mm, double conic, double diameter_mm, double vertex_mm,
                   double hole_mm = 0.0) {
    return text("[surface]\nideal = {reflect = 1, transmit = 0}\n[[object]]\nname = 'mirror'\nsurface = "
                "'ideal'\nshape = {conic_mirror = {radius_mm = ",
                radius_mm, ", conic = ", conic, ", diameter_mm = ", diameter_mm,
                ", hole_diameter_mm = ", hole_mm, "}}\nmove_mm = ", dvec3(0.0, 0.0, vertex_mm), "\n");
}

std::string rays(std::vector<std::array<dvec3, 2>> const& list) {
    std::string rows;
    for (auto const& [from, toward] : list)
        rows += text("[", from.x, ", ", from.y, ", ", from.z, ", ", toward.x, ", ", toward.y, ", ", toward.z,
                     "], ");
    return "[[source]]\nname = 'rays'\nrays = [" + rows + "]\n";
}

/// From the line that a segment runs along, mm.
double miss_mm(Segment const& segment, dvec3 const& point_mm) {
    return length(cross(point_mm - 1e3 * segment.origin, segment.direction));
}

} // namespace

TEST_CASE("a paraboloid sends every ray along its axis through the focus, by one path") {
    BankCase const c = bank("conic_mirror").at(0);
    double const f = c.input("f_mm"), start = c.input("start_z_mm");
    auto const& places = std::get<Array>(c.input_value("rays_xy_mm").data);
    std::vector<std::array<dvec3, 2>> list;
    for (Value const& place : places) {
        auto const& xy = std::get<Array>(place.data);
        list.push_back({dvec3(decimal(xy[0]), decimal(xy[1]), start), dvec3(0, 0, -1)});
    }
    Run const run = bench::run(mirror(2.0 * f, -1.0, 400.0, 0.0) + rays(list), {"trace.max_depth=1"});
    for (std::size_t i = 0; i < list.size(); ++i) {
        Segment const back = branch(rows_of(run, i), {Event::reflected});
        std::string const key = text("ray", i, "_");
        agrees(c, key + "hit_z_mm", 1e3 * back.origin.z);
        agrees(c, key + "dirx", back.direction.x);
        agrees(c, key + "dirz", back.direction.z);
        dvec3 const to_focus = dvec3(0.0, 0.0, f) - 1e3 * back.origin;
        agrees(c, key + "path_mm", start - 1e3 * back.origin.z + dot(to_focus, back.direction));
        agrees(c, "transverse_error_mm", miss_mm(back, {0.0, 0.0, f}));
        CHECK(length(cross(normalize(to_focus), back.direction)) <= 1e-13); // rad
    }
}

TEST_CASE("an ellipsoid sends every ray from one focus through the other, by one path") {
    BankCase const c = bank("conic_mirror").at(1);
    double const a = c.input("a_mm"), b = c.input("b_mm"), focus = std::sqrt(a * a - b * b);
    // the conic with its vertex at −a is the whole lower half: R = b²/a, k = b²/a² − 1; another, upside down,
    // is the upper one
    double const radius = b * b / a, conic = b * b / (a * a) - 1.0;
    std::string upper = mirror(-radius, conic, 2.0 * b * (1.0 - 1e-9), a);
    upper = upper.substr(upper.find("[[object]]"));
    upper.replace(upper.find("'mirror'"), 8, "'upper'");
    auto const& angles = std::get<Array>(c.input_value("ray_angles_to_z_deg").data);
    std::vector<std::array<dvec3, 2>> list;
    for (Value const& angle : angles) {
        double const to_axis = radians(decimal(angle));
        list.push_back({dvec3(0, 0, -focus), dvec3(std::sin(to_axis), 0.0, std::cos(to_axis))});
    }
    Run const run = bench::run(mirror(radius, conic, 2.0 * b * (1.0 - 1e-9), -a) + upper + rays(list),
                               {"trace.max_depth=1"});
    for (std::size_t i = 0; i < list.size(); ++i) {
        Segment const back = branch(rows_of(run, i), {Event::reflected});
        std::string const key = text("ray", i, "_");
        agrees(c, key + "hit_x_mm", 1e3 * back.origin.x);
        agrees(c, key + "hit_z_mm", 1e3 * back.origin.z);
        agrees(c, key + "dirx", back.direction.x);
        agrees(c, key + "dirz", back.direction.z);
        dvec3 const to_focus = dvec3(0.0, 0.0, focus) - 1e3 * back.origin;
        agrees(c, "path_mm", length(1e3 * back.origin - list[i][0]) + length(to_focus));
        CHECK(length(cross(normalize(to_focus), back.direction)) <= 1e-13); // rad
    }
}

TEST_CASE("an ellipsoidal surface of k = −1/n² brings a beam to a point within the glass, by one path") {
    for (BankCase const& c : bank("cartesian_refractor")) {
        double const n = c.input("n"), focus = c.input("focus_mm"), start = c.input("start_z_mm");
        auto const& heights = std::get<Array>(c.input_value("ray_heights_mm").data);
        std::vector<std::array<dvec3, 2>> list;
        for (Value const& height : heights)
            list.push_back({dvec3(decimal(height), 0, start), dvec3(0, 0, 1)});
        Run const run = bench::run(text("[medium]\nglass = {n = ", n,
                                        "}\n[[object]]\nname = 'lens'\nmedium = 'glass'\nshape = {lens = "
                                        "{r1_mm = ",
                                        focus * (n - 1.0) / n, ", conic1 = ", -1.0 / (n * n),
                                        ", thickness_mm = 60, diameter_mm = 24}}\n") +
                                   rays(list));
        for (std::size_t i = 0; i < list.size(); ++i) {
            Segment const in = branch(rows_of(run, i), {Event::refracted});
            std::string const key = text("ray", i, "_");
            agrees(c, key + "hit_z_mm", 1e3 * in.origin.z);
            agrees(c, key + "dirx", in.direction.x);
            dvec3 const to_focus = dvec3(0.0, 0.0, focus) - 1e3 * in.origin;
            agrees(c, key + "opl_mm", 1e3 * in.origin.z - start + n * length(to_focus));
            CHECK(length(cross(normalize(to_focus), in.direction)) <= 1e-13); // rad
        }
    }
}

TEST_CASE("a plano-hyperbolic lens of k = −n² brings a beam through its plane face to a point behind it") {
    double const n = 1.5, focus = 100.0, thickness = 12.0;
    Run const run = bench::run(
        text("[medium]\nglass = {n = ", n,
             "}\n[[object]]\nname = 'lens'\nmedium = 'glass'\nshape = {lens = {r2_mm = ", -focus * (n - 1.0),
             ", conic2 = ", -n * n, ", thickness_mm = ", thickness, ", diameter_mm = 40}}\n") +
        rays({{dvec3(19, 0, -5), dvec3(0, 0, 1)},
              {dvec3(3, -8, -5), dvec3(0, 0, 1)},
              {dvec3(0, 0.01, -5), dvec3(0, 0, 1)}}));
    for (std::uint64_t i = 0; i < 3; ++i) {
        Segment const out = branch(rows_of(run, i), {Event::refracted, Event::refracted});
        dvec3 const to_focus = dvec3(0.0, 0.0, thickness + focus) - 1e3 * out.origin;
        CHECK(length(cross(normalize(to_focus), out.direction)) <= 1e-13); // rad
    }
}

TEST_CASE("a mirror's hole lets light pass, and its back reflects too") {
    Run const run =
        bench::run(mirror(200.0, -1.0, 100.0, 0.0, 20.0) + rays({{dvec3(9.99, 0, 50), dvec3(0, 0, -1)},
                                                                 {dvec3(10.01, 0, 50), dvec3(0, 0, -1)},
                                                                 {dvec3(30, 0, -50), dvec3(0, 0, 1)},
                                                                 {dvec3(50.01, 0, 50), dvec3(0, 0, -1)}}));
    CHECK(rows_of(run, 0).size() == 1);
    CHECK(rows_of(run, 1).size() == 2);
    CHECK(rows_of(run, 3).size() == 1);
    // the virtual focus is where the real one is
    Segment const back = branch(rows_of(run, 2), {Event::reflected});
    CHECK(miss_mm(back, {0.0, 0.0, 100.0}) <= 1e-11);
    CHECK(back.direction.z < 0.0);
}

TEST_CASE("a glass corner cube returns rays antiparallel from inside, whatever face they meet first") {
    std::string const cube =
        "[medium]\nglass = {n = 1.5}\n[surface]\nideal = {reflect = 1, transmit = 0}\n"
        "[[object]]\nname = 'cube'\nmedium = 'glass'\nshape = {corner_cube = {side_mm = 30}}\n"
        "faces = {x = 'ideal', y = 'ideal', z = 'ideal'}\n";
    dvec3 const axis = normalize(dvec3(-1.0));
    for (dvec3 const& aim : {dvec3(1, 2, 3), dvec3(3, 1, 2), dvec3(2.5, 3, 1), dvec3(1, 1.5, 0.5)}) {
        dvec3 const toward = normalize(axis + dvec3(0.05, -0.03, 0.01));
        Run const run = bench::run(cube + rays({{aim - 60.0 * toward, toward}}));
        Segment const out = branch(rows_of(run, 0), {Event::refracted, Event::reflected, Event::reflected,
                                                     Event::reflected, Event::refracted});
        CHECK(length(cross(out.direction, toward)) <= 1e-15);
        CHECK(dot(out.direction, toward) < 0.0);
    }
}

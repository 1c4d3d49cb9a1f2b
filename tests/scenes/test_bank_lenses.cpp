// In: the bank's lenses. Out: whether skew rays traced through them arrive where, whither and with what
// optical path an exact trace in 50 digits says. The first vertex is the origin, rays start in z = −10 mm, a
// detector is the image plane.
#include "support/bank.h"
#include "support/bench.h"
#include "support/catch.h"
#include "support/textbook.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

/// The bank gives where a ray would meet z = 0 and its slopes in degrees.
std::string rays_of(BankCase const& c) {
    std::string rays;
    for (Value const& value : std::get<Array>(c.input_value("rays_aim_at_z0_xy_mm_and_angles_deg").data)) {
        auto const& ray = std::get<Array>(value.data);
        double const x = std::tan(radians(decimal(ray[2]))), y = std::tan(radians(decimal(ray[3])));
        rays += text("[", decimal(ray[0]) - 10.0 * x, ", ", decimal(ray[1]) - 10.0 * y, ", -10, ", x, ", ", y,
                     ", 1], ");
    }
    return rays;
}

struct Surfaces {
    double first, second, thickness; // mm; a radius of 0 is a plane
};

std::string lens(char const* name, Surfaces const& s, double vertex_mm) {
    return text("[[object]]\nname = '", name, "'\nmedium = '", name, "'\nshape = {lens = {r1_mm = ", s.first,
                ", r2_mm = ", s.second, ", thickness_mm = ", s.thickness,
                ", diameter_mm = 25}}\nmove_mm = ", dvec3(0.0, 0.0, vertex_mm), "\n");
}

std::string image_plane(BankCase const& c, double z_mm) {
    return text("[[source]]\nname = 'rays'\nrays = [", rays_of(c),
                "]\n[[detector]]\nname = 'image'\nfacing = [0, 0, -1]\nsize_mm = [40, 40]\nat_mm = ",
                dvec3(0.0, 0.0, z_mm), "\n");
}

double radius_mm(Value const& value) {
    auto const* const text = std::get_if<std::string>(&value.data);
    return text && *text == "inf" ? 0.0 : decimal(value);
}

/// Compares whatever the bank gives of this ray.
void check_ray(BankCase const& c, Rows const& path, std::size_t number) {
    Segment const& last = path.back();
    REQUIRE(last.ended == Event::detected);
    std::string const ray = "ray" + std::to_string(number) + "_";
    agrees(c, ray + "x_mm", 1e3 * end_of(last).x);
    agrees(c, ray + "y_mm", 1e3 * end_of(last).y);
    agrees(c, ray + "opl_mm", 1e3 * last.optical_path);
    agrees(c, ray + "dirz", last.direction.z);
    if (c.outputs.find(ray + "dirx")) {
        agrees(c, ray + "dirx", last.direction.x);
        agrees(c, ray + "diry", last.direction.y);
    }
}

} // namespace

TEST_CASE("a singlet sends real rays where an exact trace does") {
    for (BankCase const& c : bank("singlet_real_ray")) {
        double const thickness = c.input("thickness_mm"), n = c.input("n");
        Surfaces const surfaces{radius_mm(c.input_value("R1_mm")), radius_mm(c.input_value("R2_mm")),
                                thickness};
        Run const run =
            bench::run(text("[medium]\nsinglet = {n = ", n, "}\n") + lens("singlet", surfaces, 0.0) +
                       image_plane(c, thickness + c.output("bfd_mm")));
        auto const rays = std::get<Array>(c.input_value("rays_aim_at_z0_xy_mm_and_angles_deg").data).size();
        for (std::size_t i = 0; i < rays; ++i) {
            Rows const path = direct_path(rows_of(run, i));
            REQUIRE(path.size() == 3);
            check_ray(c, path, i);
        }
    }
}

TEST_CASE("near the axis a singlet has the focal length of the lensmaker's equation") {
    for (BankCase const& c : bank("singlet_real_ray")) {
        double const thickness = c.input("thickness_mm"), n = c.input("n"), small = 1e-3;
        Surfaces const surfaces{radius_mm(c.input_value("R1_mm")), radius_mm(c.input_value("R2_mm")),
                                thickness};
        Run const run =
            bench::run(text("[medium]\nsinglet = {n = ", n, "}\n") + lens("singlet", surfaces, 0.0) +
                       text("[[source]]\nname = 'rays'\nrays = [[0, ", small, ", -10, 0, 0, 1]]\n"));
        Segment const out = direct_path(rows_of(run, 0)).back();
        double const slope = -out.direction.y / out.direction.z;
        // real rays depart from paraxial ones with the square of height over radius, 4e-10, times lengths of
        // 100 mm
        agrees(c, "efl_mm", small / slope, 1e-7);
        agrees(c, "bfd_mm", 1e3 * (out.origin.z + out.origin.y / slope) - thickness, 1e-7);
    }
}

TEST_CASE(
    "a cemented doublet sends real rays where an exact trace does, and each cemented face is met once") {
    for (BankCase const& c : bank("multi_surface")) {
        auto const& list = std::get<Array>(c.input_value("surfaces_R_thickness_mm").data);
        auto const& media = std::get<Array>(c.input_value("n_list").data);
        std::string experiment = "[medium]\n";
        for (std::size_t i = 0; i + 1 < list.size(); ++i)
            experiment += text("lens", i, " = {n = ", decimal(media[i + 1]), "}\n");
        double vertex = 0.0;
        for (std::size_t i = 0; i + 1 < list.size(); ++i) {
            auto const& front = std::get<Array>(list[i].data);
            auto const& back = std::get<Array>(list[i + 1].data);
            experiment += lens(text("lens", i).c_str(),
                               {radius_mm(front[0]), radius_mm(back[0]), decimal(front[1])}, vertex);
            vertex += decimal(front[1]);
        }
        Run const run = bench::run(experiment + image_plane(c, c.input("image_plane_z_mm")));
        auto const rays = std::get<Array>(c.input_value("rays_aim_at_z0_xy_mm_and_angles_deg").data).size();
        for (std::size_t i = 0; i < rays; ++i) {
            Rows const path = direct_path(rows_of(run, i));
            REQUIRE(path.size() == list.size() + 1); // 4 segments for 3 surfaces
            for (Segment const& segment : path)
                CHECK(segment.length > 1e-3);
            check_ray(c, path, i);
        }
    }
}

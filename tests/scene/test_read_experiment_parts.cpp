// Media, surfaces, motions, sources and detectors one by one: each key has its effect, in its unit.
#include "scene/read_transform.h"

#include "scene/read_text.h"
#include "support/catch.h"

#include <cmath>
#include <numbers>

using namespace sahl;

namespace {

Medium medium(std::string const& definition) {
    return read_text("surroundings = \"m\"\nmedium.m = " + definition + "\n" + one_source).media.at(0);
}

Affine motion(std::string const& keys, std::string const& groups = "") {
    return read_text(groups +
                     "[[object]]\nname = \"o\"\nmedium = \"N-BK7\"\nshape = {sphere = {radius_mm = 1}}\n" +
                     keys + "\n" + one_source)
        .objects.at(0)
        .to_world;
}

SourceSpec source(std::string const& keys, std::string const& groups = "") {
    return read_text(groups + "[[source]]\nname = \"s\"\n" + keys + "\n").sources.at(0);
}

} // namespace

TEST_CASE("media by constant, Abbe number, Sellmeier, Cauchy and table have the index of their formula") {
    double const d = 587.5618e-9, um = 0.5876;
    CHECK(refractive_index(medium("{n = 1.45}").index, d) == 1.45);
    CHECK(refractive_index(medium("{nd = 1.62, vd = 36.4}").index, d) == Approx(1.62).margin(1e-5));
    CHECK(refractive_index(medium("{sellmeier = {B = [1.25], C_um2 = [0.01]}}").index, 0.5876e-6) ==
          Approx(std::sqrt(1.0 + 1.25 * um * um / (um * um - 0.01))).epsilon(1e-14));
    CHECK(refractive_index(medium("{cauchy = {A = 1.5, B_um2 = 0.004, C_um4 = 1e-4}}").index, 0.5876e-6) ==
          Approx(1.5 + 0.004 / (um * um) + 1e-4 / (um * um * um * um)).epsilon(1e-14));
    Medium const table = medium("{table = [[400, 1.5], [600, 1.4], [700, 1.3]]}");
    CHECK(refractive_index(table.index, 500e-9) == Approx(1.45).epsilon(1e-14));
    CHECK(table.range.first == Approx(400e-9));
    CHECK(table.range.second == Approx(700e-9));
}

TEST_CASE("absorption in 1/mm arrives in 1/m") {
    CHECK(absorption_coefficient(medium("{n = 1.45, absorption_per_mm = 0.01}"), 5e-7) == Approx(10.0));
    Medium const table = medium("{n = 1.45, absorption = [[400, 0.02], [700, 0.001]]}");
    CHECK(absorption_coefficient(table, 400e-9) == Approx(20.0));
    CHECK(absorption_coefficient(table, 550e-9) == Approx(10.5));
    CHECK(absorption_coefficient(medium("{glass = \"N-SF11\"}"), 400e-9) > 0.0);
    CHECK(absorption_coefficient(medium("{glass = \"N-SF11\", absorption = false}"), 400e-9) == 0.0);
}

TEST_CASE(
    "one glass under two of its names is one medium, and a name of the file goes before the catalogue") {
    std::string const bodies =
        "[[object]]\nname = \"a\"\nshape = {sphere = {radius_mm = 1}}\nmedium = \"N-BK7\"\n"
        "[[object]]\nname = \"b\"\nshape = {sphere = {radius_mm = 1}}\nmedium = \"SCHOTT:N-BK7\"\n";
    Experiment const e = read_text(bodies + one_source);
    CHECK(e.objects[0].medium == e.objects[1].medium);
    Experiment const own = read_text("medium.N-BK7 = {n = 3}\n" + bodies + one_source);
    CHECK(refractive_index(own.media.at(own.objects[0].medium->value).index, 5e-7) == 3.0);
}

TEST_CASE("a wavelength outside a formula's range is a warning that names both") {
    Experiment const e =
        read_text("surroundings = \"N-BK7\"\n" + std::string(one_source) + "wavelengths_nm = [200, 500]\n");
    REQUIRE(e.warnings.size() == 1);
    CHECK(e.warnings[0].find("200.0 nm") != std::string::npos);
    CHECK(e.warnings[0].find("BK7") != std::string::npos);
}

TEST_CASE("sines and cosines of multiples of 30° are exact") {
    for (int turns = -2; turns <= 2; ++turns) {
        double const full = 360.0 * turns;
        CHECK(sin_of_deg(full) == 0.0);
        CHECK(sin_of_deg(full + 90) == 1.0);
        CHECK(sin_of_deg(full + 180) == 0.0);
        CHECK(sin_of_deg(full + 270) == -1.0);
        CHECK(cos_of_deg(full + 90) == 0.0);
        CHECK(cos_of_deg(full + 180) == -1.0);
        CHECK(cos_of_deg(full + 270) == 0.0);
        CHECK(sin_of_deg(full + 30) == 0.5);
        CHECK(sin_of_deg(full + 210) == -0.5);
        CHECK(cos_of_deg(full + 60) == 0.5);
        CHECK(cos_of_deg(full + 120) == -0.5);
    }
    for (double angle = -720.0; angle <= 720.0; angle += 7.3) {
        CHECK(sin_of_deg(angle) == Approx(std::sin(angle * std::numbers::pi / 180.0)).margin(1e-14));
        CHECK(cos_of_deg(angle) == Approx(std::cos(angle * std::numbers::pi / 180.0)).margin(1e-14));
    }
}

TEST_CASE("a quarter turn about each axis is exact and right-handed") {
    dvec3 const x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    CHECK(motion("turn_deg = [90, 0, 0]").vector(y) == z);
    CHECK(motion("turn_deg = [0, 90, 0]").vector(z) == x);
    CHECK(motion("turn_deg = [0, 0, 90]").vector(x) == y);
}

TEST_CASE("scale goes first, then turns about x, y, z, then the move") {
    Affine const map = motion("scale = [2, 3, 4]\nturn_deg = [90, 90, 90]\nmove_mm = [1, 2, 3]");
    // (1,1,1) scaled: (2,3,4); about x: (2,-4,3); about y: (3,-4,-2); about z: (4,3,-2)
    CHECK(map.point(dvec3(1.0)) == dvec3(4, 3, -2) + dvec3(0.001, 0.002, 0.003));
    CHECK(motion("scale = 2").linear == dmat3(2.0));
}

TEST_CASE("a matrix is written column by column with lengths in mm") {
    Affine const map = motion("matrix = [0, 1, 0, 0,  -1, 0, 0, 0,  0, 0, 1, 0,  10, 20, 30, 1]");
    CHECK(map == motion("turn_deg = [0, 0, 90]\nmove_mm = [10, 20, 30]"));
}

TEST_CASE("groups nest: the object's own motion first, then its group's, then that group's group's") {
    std::string const groups = "[[group]]\nname = \"inner\"\ngroup = \"outer\"\nturn_deg = [0, 0, 90]\n"
                               "[[group]]\nname = \"outer\"\nmove_mm = [0, 0, 5]\n";
    Affine const map = motion("group = \"inner\"\nmove_mm = [1, 0, 0]", groups);
    CHECK(map.point(dvec3(0.0)) == dvec3(0.0, 0.001, 0.005));
}

TEST_CASE("a group turns and moves its sources and detectors") {
    std::string const groups = "[[group]]\nname = \"g\"\nturn_deg = [0, 0, 90]\nmove_mm = [0, 0, 5]\n";
    auto const beam = std::get<Beam>(
        source("group = \"g\"\nbeam = {from_mm = [1, 0, 0], toward = [7, 0, 0], up = [0, 0, 2]}", groups)
            .emitter);
    CHECK(beam.from == dvec3(0.0, 0.001, 0.005));
    CHECK(beam.toward == dvec3(0.0, 1.0, 0.0));
    CHECK(beam.up == dvec3(0.0, 0.0, 1.0));
    Experiment const e =
        read_text(groups + one_source + "[[detector]]\nname = \"d\"\ngroup = \"g\"\nat_mm = [1, 0, 0]\n" +
                  "facing = [1, 0, 0]\nup = [1, 1, 0]\nsize_mm = [2, 4]\nabsorbs = false\nback = true\n");
    DetectorSpec const& d = e.detectors.at(0);
    CHECK(d.to_world.linear[2] == dvec3(0, 1, 0));
    CHECK(d.to_world.linear[1] == dvec3(-1, 0, 0));
    CHECK(d.to_world.linear[0] == cross(d.to_world.linear[1], d.to_world.linear[2]));
    CHECK(d.to_world.offset == dvec3(0.0, 0.001, 0.005));
    CHECK(d.size == dvec2(0.002, 0.004));
    CHECK((!d.absorbs && d.back));
}

TEST_CASE("every kind of emitter is read in metres, radians and unit vectors") {
    auto const beam = std::get<Beam>(
        source("beam = {from_mm = [1, 2, 3], toward = [0, 0, 1e-200], size_mm = [4, 6], rays = 1e3, "
               "pattern = \"sobol\", profile = {gaussian_radius_mm = 2}}")
            .emitter);
    CHECK(beam.toward == dvec3(0, 0, 1));
    CHECK(beam.size == dvec2(0.004, 0.006));
    CHECK(beam.rays == 1000);
    CHECK(beam.pattern == Pattern::sobol);
    CHECK(beam.gaussian_radius == 0.002);
    auto const point = std::get<PointEmitter>(source("point = {at_mm = [0, 0, 1], rays = 10}").emitter);
    CHECK(point.half_angle == std::numbers::pi);
    CHECK(point.at == dvec3(0, 0, 0.001));
    auto const cone = std::get<PointEmitter>(
        source("point = {at_mm = [0, 0, 1], toward = [0, 3, 4], half_angle_deg = 30, rays = 10}").emitter);
    CHECK(cone.toward == dvec3(0, 0.6, 0.8));
    CHECK(cone.half_angle == Approx(std::numbers::pi / 6.0));
    auto const lamp = std::get<LambertianEmitter>(
        source("lambertian = {at_mm = [0, 0, 1], toward = [0, 0, -1], size_mm = [1, 2], rays = 5}").emitter);
    CHECK(lamp.size == dvec2(0.001, 0.002));
    CHECK(lamp.toward == dvec3(0, 0, -1));
}

TEST_CASE("rays with powers give a source the sum of them, unless it says otherwise") {
    SourceSpec const s = source("rays = [[0, 0, 1, 0, 0, 2, 0.5], [0, 1, 0, 3, 0, 4, 1.5]]");
    CHECK(s.power == 2.0);
    auto const& rays = std::get<ExplicitRays>(s.emitter).rays;
    CHECK(rays.at(0).origin == dvec3(0, 0, 0.001));
    CHECK(rays[1].direction == dvec3(0.6, 0, 0.8));
    CHECK(rays[1].weight == 1.5);
    CHECK(source("rays = [[0, 0, 1, 0, 0, 2, 0.5]]\npower_W = 3").power == 3.0);
    CHECK(source("rays = [[0, 0, 1, 0, 0, 2]]").power == 1.0);
}

TEST_CASE("a file of rays may have a header, comments, blank lines and line ends of any kind") {
    TemporaryFolder const folder;
    folder.write("rays.csv",
                 "# two rays\r\nx,y,z,dx,dy,dz,power\r\n\r\n0, 0, 1, 0, 0, 1, 0.25\r\n+1,2,3,1e3,0,0,0.5");
    Experiment const e =
        read_text("[[source]]\nname = \"s\"\nfile = \"rays.csv\"\n", folder.path / "test.toml");
    auto const& rays = std::get<ExplicitRays>(e.sources.at(0).emitter).rays;
    REQUIRE(rays.size() == 2);
    CHECK(rays[1].origin == dvec3(0.001, 0.002, 0.003));
    CHECK(rays[1].direction == dvec3(1, 0, 0));
    CHECK(e.sources[0].power == 0.75);
}

TEST_CASE("spectral lines have their wavelengths, and weights go with them in order") {
    SourceSpec const s =
        source("rays = [[0, 0, 0, 0, 0, 1]]\nlines = [\"F\", \"d\", \"C'\"]\nweights = [1, 2, 3]");
    CHECK(s.wavelengths == std::vector<std::pair<double, double>>{
                               {486.1327 * 1e-9, 1.0}, {587.5618 * 1e-9, 2.0}, {643.8469 * 1e-9, 3.0}});
}

TEST_CASE("a closed shape whose faces all have a surface needs no medium") {
    std::string const surface = "surface.w = {absorb = true}\n[[object]]\nname = \"o\"\n";
    CHECK(!read_text(surface + "surface = \"w\"\nshape = {box = {size_mm = [1, 1, 1]}}\n" + one_source)
               .objects[0]
               .medium);
    CHECK(read_text(surface +
                    "faces = {side = \"w\", back = \"w\", front = \"w\"}\n"
                    "shape = {cylinder = {radius_mm = 1, length_mm = 1}}\n" +
                    one_source)
              .objects[0]
              .faces.size() == 3);
}

TEST_CASE("every shape of the contract is read, in metres") {
    std::string text = "surface.w = {reflect = 0.5}\n";
    for (std::string const shape :
         {"sphere = {radius_mm = 1}", "box = {size_mm = [1, 2, 3]}",
          "cylinder = {radius_mm = 1, length_mm = 2}",
          "lens = {r1_mm = 50, thickness_mm = 4, diameter_mm = 20, conic1 = -2, aspheric2 = [1e-6, 2e-9]}",
          "prism = {apex_deg = 90, side_mm = 1, length_mm = 1}", "plane = {}",
          "rectangle = {size_mm = [1, 2]}", "disk = {radius_mm = 2, hole_radius_mm = 1}",
          "cone = {radius_mm = 2, length_mm = 3}", "corner_cube = {side_mm = 2}",
          "quadric = {coefficients = [1, 1, 1, 0, 0, 0, 2, 0, 0, -9], clip_mm = [4, 5, 6]}",
          "conic_mirror = {radius_mm = 50, conic = -1, diameter_mm = 20}"})
        text += "[[object]]\nname = \"" + shape.substr(0, shape.find(' ')) +
                "\"\nsurface = \"w\"\nshape = {" + shape + "}\n";
    Experiment const e = read_text(text + one_source);
    REQUIRE(e.objects.size() == 12);
    for (std::size_t i = 0; i < 12; ++i)
        CHECK(std::get<Shape>(e.objects[i].what).index() == i);
    auto const& lens = std::get<Lens>(std::get<Shape>(e.objects[3].what));
    CHECK(lens.r1 == 0.05);
    CHECK(lens.r2 == 0.0);
    CHECK(lens.conic1 == -2.0);
    REQUIRE(lens.aspheric2.size() == 2);
    CHECK(lens.aspheric2[0] == Approx(1e3)); // 1e-6 mm⁻³
    CHECK(lens.aspheric2[1] == Approx(2e6)); // 2e-9 mm⁻⁵
    auto const& quadric = std::get<QuadricBody>(std::get<Shape>(e.objects[10].what));
    CHECK(quadric.coefficients == std::array{1e6, 1e6, 1e6, 0.0, 0.0, 0.0, 2e3, 0.0, 0.0, -9.0});
    CHECK(quadric.clip.z == 0.006);
    CHECK(std::get<Disk>(std::get<Shape>(e.objects[7].what)).hole_radius == 0.001);
}

// An experiment's bodies as a .glb: what our own reader makes of it is the same bodies, of the same glass.
#include "support/catch.h"
#include "support/gltf.h"

#include "math/input_error.h"
#include "run/export_model.h"
#include "scene/read_gltf.h"

#include <cmath>

using namespace sahl;
using namespace sahl::bench;
namespace fs = std::filesystem;

namespace {

std::string const bodies = R"(
medium.tinted = {n = 1.5, absorption_per_mm = 0.01}
medium.mine = {nd = 1.62, vd = 36.4}
surface.silver = {metal = "silver"}
surface.wall = {absorb = true}
[[object]]
name = "ball"
shape = {sphere = {radius_mm = 5}}
medium = "N-BK7"
[[object]]
name = "same"
shape = {sphere = {radius_mm = 5}}
medium = "N-BK7"
move_mm = [20, 0, 0]
turn_deg = [10, 20, 30]
[[object]]
name = "box"
shape = {box = {size_mm = [5, 6, 7]}}
medium = "mine"
move_mm = [40, 0, 0]
faces = {left = "silver", top = "wall"}
[[object]]
name = "cone"
shape = {cone = {radius_mm = 5, top_radius_mm = 0, length_mm = 8}}
medium = "tinted"
move_mm = [60, 0, 0]
[[object]]
name = "lens"
shape = {lens = {r1_mm = 20, r2_mm = -20, thickness_mm = 6, diameter_mm = 14, conic1 = -0.6, aspheric1 = [1e-5]}}
medium = "N-SF11"
move_mm = [80, 0, 0]
scale = [1, 1.5, -1]
turn_deg = [0, 30, 0]
[[object]]
name = "quadric"
shape = {quadric = {coefficients = [1, 1, -1, 0, 0, 0, 0, 0, 0, -4], clip_mm = [10, 10, 10]}}
medium = "N-BK7"
move_mm = [100, 0, 0]
[[object]]
name = "sheared"
shape = {prism = {apex_deg = 60, side_mm = 10, length_mm = 8}}
medium = "N-BK7"
matrix = [-1, 0.3, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 30, 0, 1]
[[object]]
name = "dish"
shape = {conic_mirror = {radius_mm = 40, conic = -1, diameter_mm = 20, hole_diameter_mm = 4}}
surface = "silver"
move_mm = [40, 30, 0]
)";

std::string const light = R"(
[[source]]
name = "beam"
beam = {from_mm = [0, 0, -30], toward = [0, 0, 1], radius_mm = 4, pattern = "hexagonal", rays = 100}
lines = ["F", "d", "C"]
[[detector]]
name = "screen"
at_mm = [0, 0, 11]
facing = [0, 0, -1]
size_mm = [4, 4]
)";

struct Exported {
    TemporaryFolder folder;
    Scene exact;
    fs::path file = folder.path / "bench.glb";

    Exported(std::string const& text, unsigned turn) : folder("export-" + std::to_string(turn)) {
        ExperimentSource const source = load_experiment(folder.write("bench.toml", text + light));
        exact = build_scene(read_experiment(source.tree, source.file));
        export_model(source, turn, file);
    }
    Scene read_back() const {
        ExperimentSource const source = load_experiment(
            folder.write("again.toml", "[[object]]\nname = \"all\"\nmodel = \"bench.glb\"\n" + light));
        return build_scene(read_experiment(source.tree, source.file));
    }
};

Body const& body_of(Scene const& scene, std::string const& name) {
    for (Body const& body : scene.bodies)
        if (body.name == name)
            return body;
    FAIL(name);
    return scene.bodies.front();
}

} // namespace

TEST_CASE("an exported experiment is read back as the same bodies in the same places", "[run]") {
    Exported const exported(bodies, 48);
    Scene const back = exported.read_back();
    for (Body const& body : exported.exact.bodies) {
        INFO(body.name);
        if (body.detector)
            continue;
        Body const& other = body_of(back, "all." + body.name);
        CHECK(other.open == body.open);
        REQUIRE(other.mesh);
        CHECK((other.open || other.mesh->closed()));
        CHECK(other.mesh->flipped_triangles == 0);
        // the sheared one is put there place by place; what else is moved, is moved by the same numbers
        if (body.name == "sheared")
            CHECK(other.to_world == Affine{});
        else
            CHECK(other.to_world == body.to_world);
        if (body.open)
            continue;
        // inside it, both say so
        dvec3 const middle = body.to_world.point(body.name == "lens"   ? dvec3(0.0, 0.0, 3e-3)
                                                 : body.name == "cone" ? dvec3(0.0, 0.0, -2e-3)
                                                                       : dvec3(0.0));
        auto const in = body_at(back, back.bvh->start_at(middle, normalize(dvec3(1, 2, 3))).inside);
        REQUIRE(in);
        CHECK(back.bodies[in->value].name == other.name);
    }
    CHECK(body_of(back, "all.ball").mesh == body_of(back, "all.same").mesh); // one mesh, two instances
}

TEST_CASE("an exported glass is read back as the same glass", "[run]") {
    Exported const exported(bodies, 24);
    Scene const back = exported.read_back();
    auto const media = [&](std::string const& name) {
        return std::pair(exported.exact.media[body_of(exported.exact, name).medium.value],
                         back.media[body_of(back, "all." + name).medium.value]);
    };
    double const d = 587.5618e-9, f = 486.1327e-9, c = 656.2725e-9;
    auto const abbe = [&](Medium const& m) {
        return (refractive_index(m.index, d) - 1.0) /
               (refractive_index(m.index, f) - refractive_index(m.index, c));
    };
    for (std::string const name : {"ball", "lens"}) { // of the catalogue: n_d and V_d
        auto const [one, other] = media(name);
        // the format's formula rounds a few times, and its 1.5168 is V_d's only to a few units of 10⁻⁵
        CHECK(refractive_index(other.index, d) == Approx(refractive_index(one.index, d)).margin(1e-6));
        CHECK(abbe(other) == Approx(abbe(one)).epsilon(2e-5));
    }
    for (double const wavelength : {400e-9, d, 700e-9}) { // by the format's own formula: everywhere
        auto const [one, other] = media("box");
        CHECK(refractive_index(other.index, wavelength) ==
              Approx(refractive_index(one.index, wavelength)).epsilon(1e-15));
        auto const [tinted, tinted_too] = media("cone");
        CHECK(refractive_index(tinted_too.index, wavelength) == 1.5);
        CHECK(absorption_coefficient(tinted_too, wavelength) == Approx(10.0).epsilon(1e-14));
    }
    // its faces
    auto const surface = [&](std::string const& face) -> Surface const* {
        for (Face const& f_of : back.faces)
            if (f_of.name == face)
                return f_of.surface ? &back.surfaces[f_of.surface->value] : nullptr;
        FAIL(face);
        return nullptr;
    };
    CHECK(surface("all.ball.N-BK7") == nullptr);
    Model const model = read_gltf(exported.file);
    auto const material = [&](std::string const& name) {
        for (ModelMaterial const& m : model.materials)
            if (m.name == name)
                return m;
        FAIL(name);
        return ModelMaterial{};
    };
    CHECK(material("wall").base_color == std::array<double, 4>{0.0, 0.0, 0.0, 1.0});
    CHECK(material("wall").metallic == 0.0);
    CHECK(material("silver").metallic == 1.0);
    CHECK(material("silver").base_color[0] > 0.9);
    CHECK(material("silver").base_color[0] < 1.0);
}

TEST_CASE("light goes through an exported ball as through the ball, the nearer the finer", "[run]") {
    std::string const ball = bodies.substr(0, bodies.find("[[object]]\nname = \"same\""));
    auto const spot = [&](Exported const& exported, std::string const& file) {
        std::string text = light;
        // by a method that does not recognise the ball
        text += "[trace]\nbranch = \"dominant\"\nmethod = \"interpolated\"\n";
        text += file.empty() ? ball.substr(ball.find("[[object]]"))
                             : "[[object]]\nname = \"all\"\nmodel = \"" + file + "\"\n";
        ExperimentSource const source = load_experiment(exported.folder.write("trace.toml", text));
        Value const summary = run_experiment(source, {}).summary;
        return std::get<double>(summary.find("detectors")->find("screen")->find("rms_radius_mm")->data);
    };
    Exported const coarse(ball, 60), fine(ball, 240);
    double const exact = spot(fine, "");
    double const by_coarse = std::abs(spot(coarse, "bench.glb") - exact),
                 by_fine = std::abs(spot(fine, "bench.glb") - exact);
    INFO(exact << " " << by_coarse << " " << by_fine);
    // normals are exact on a sphere's chords too, so that places alone err: by the square of the fineness
    CHECK(by_coarse / by_fine > 10.0);
    CHECK(by_fine < 1e-3 * exact);
}

TEST_CASE("shapes are exported without a source of light", "[run]") {
    TemporaryFolder const folder("export-dark");
    fs::path const file = folder.path / "ball.glb";
    export_model(load_experiment(folder.write("ball.toml", "[medium]\nglass = {n = 1.5}\n[[object]]\nname = "
                                                           "\"ball\"\nshape = {sphere = {radius_mm = 5}}\n"
                                                           "medium = \"glass\"\n")),
                 24, file);
    CHECK(fs::file_size(file) > 1000);
}

TEST_CASE("what cannot be exported is said, and nothing is written", "[run]") {
    TemporaryFolder const folder("export-not");
    auto const message = [&](std::string const& object, unsigned turn) -> std::string {
        ExperimentSource const source = load_experiment(folder.write(
            "bench.toml", "surface.wall = {absorb = true}\n[[object]]\nname = \"it\"\n" + object + light));
        try {
            export_model(source, turn, folder.path / "bench.glb");
        } catch (InputError const& error) {
            CHECK_FALSE(fs::exists(folder.path / "bench.glb"));
            return error.what();
        }
        return {};
    };
    std::string const plane = message("shape = {plane = {}}\nsurface = \"wall\"\n", 96);
    CHECK(plane.find("bench.toml: object it: a plane has no end") != std::string::npos);
    CHECK(plane.find("rectangle") != std::string::npos);
    CHECK(message("shape = {quadric = {coefficients = [1, 1, 1, 0, 0, 0, 0, 0, 0, 1], clip_mm = [1, 1, 1]}}\n"
                  "medium = \"N-BK7\"\n",
                  96)
              .find("encloses nothing") != std::string::npos);
    CHECK(message("shape = {sphere = {radius_mm = 1}}\nmedium = \"N-BK7\"\n", 96).empty());
}

// What a check says of the fineness of meshes, held against balls of other fineness and against the sphere.
#include "run/mesh_fit.h"

#include "geometry/data_steps.h"
#include "math/random.h"
#include "run/check.h"
#include "run/export_model.h"
#include "run/path_errors.h"
#include "support/catch.h"
#include "support/curved.h"
#include "support/gltf.h"
#include "support/lab.h"

#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr double radius = 5e-3;

struct Probe {
    Scene scene;
    WavelengthTable optics;
    Emission emission;
    TraceOptions options;
};

Probe probe(std::shared_ptr<Mesh const> const& mesh, double tolerance) {
    Lab lab;
    MediumId const glass = lab.medium(1.5);
    Scene scene = with_meshes(build_scene(lab.experiment), {{"body", mesh, glass, {}, 0}});
    scene.sources = probing_beams(scene);
    WavelengthTable optics(scene);
    Emission emission(scene.sources, optics, 1);
    TraceOptions options;
    options.max_depth = 2;
    options.tolerance = tolerance;
    return {std::move(scene), std::move(optics), std::move(emission), options};
}

MethodLevels levels_of(std::shared_ptr<Mesh const> const& mesh) {
    Probe p = probe(mesh, 1e-6);
    return MethodPilots(p.scene, p.optics, p.emission, p.options, curvable_meshes(p.scene)).levels({0});
}

MethodLevel level(MethodLevels const& found, Method method) {
    for (MethodLevel const& one : found.levels)
        if (one.method == method)
            return one;
    FAIL("no level of this method");
    return {};
}

Value const& fit_of(Value const& fits) {
    return *fits.find("models")->find("body");
}

} // namespace

TEST_CASE("as many triangles as a check of fineness asks for bring a method to the tolerance", "[curved]") {
    constexpr std::uint32_t coarse = 8;
    double const triangles = 20.0 * coarse * coarse;
    MethodLevels const found = levels_of(float_ball(radius, coarse));
    for (Method const method : {Method::facet, Method::interpolated}) {
        MethodLevel const before = level(found, method);
        double const tolerance = before.bound / 6.0;
        auto const needed = triangles_for(before, triangles, tolerance, 0.0);
        REQUIRE(needed);
        auto const frequency = static_cast<std::uint32_t>(std::lround(std::sqrt(*needed / 20.0)));
        double const after = level(levels_of(float_ball(radius, frequency)), method).bound;
        CHECK(after < 2.0 * tolerance); // the worst of 768 rays is drawn from a tail
        CHECK(after > 0.5 * tolerance);
    }
}

TEST_CASE("what the digits of a fine ball leave open is what its fitted directions err by", "[curved]") {
    Probe p = probe(float_ball(radius, 40), 1e-8); // finer, and digits alone are left to err
    double const floor =
        MethodPilots(p.scene, p.optics, p.emission, p.options, curvable_meshes(p.scene)).floor_of({0});
    Lab lab;
    MediumId const glass = lab.medium(1.5);
    lab.body("body", Sphere{radius}, glass);
    Scene exact = build_scene(lab.experiment);
    std::vector<std::uint64_t> const rays = spread_rays(p.emission, 500, 0.6);
    p.scene.bvh = bvh_with(p.scene, std::vector<BodyMethod>{body_method(Method::fitted)});
    double const error = compare_paths(trees_of(p.scene, p.optics, p.emission, p.options, rays),
                                       trees_of(exact, p.optics, p.emission, p.options, rays), false)
                             .rms;
    WARN("float digits of a ball of 32 000 triangles: " << floor << " rad by shaking, " << error
                                                        << " against the sphere, RMS");
    CHECK(floor > 0.5 * error);
    CHECK(floor < 2.0 * error);
}

TEST_CASE("averaged normals are told from those of the surface, and places alone are used", "[curved]") {
    TriangleSoup soup = geodesic_soup(radius, 16); // triangles of uneven size, so that averages are off
    for (dvec3& p : soup.positions)
        p = p * dvec3(1.0, 0.7, 1.4);
    std::map<std::array<double, 3>, dvec3> sums;
    auto const key = [](dvec3 const& p) {
        dvec3 const q = as_float(p);
        return std::array<double, 3>{q.x, q.y, q.z};
    };
    for (auto const& [a, b, c] : soup.triangles) {
        dvec3 const area =
            cross(soup.positions[b] - soup.positions[a], soup.positions[c] - soup.positions[a]);
        for (std::uint32_t const corner : {a, b, c})
            sums[key(soup.positions[corner])] += area;
    }
    auto const averaged = float_mesh(soup, [&](dvec3 const& p) { return normalize(sums[key(p)]); });
    auto const exact = float_mesh(soup, [](dvec3 const& p) { return normalize(p / dvec3(1.0, 0.49, 1.96)); });
    Probe rough = probe(averaged, 1e-5), good = probe(exact, 1e-5);
    Value const of_rough = mesh_fits(rough.scene, rough.optics, rough.emission, rough.options),
                of_good = mesh_fits(good.scene, good.optics, good.emission, good.options);
    CHECK(std::get<std::string>(fit_of(of_rough).find("normals")->data) == "first_order");
    CHECK(std::get<std::string>(fit_of(of_good).find("normals")->data) == "used");
    CHECK(fits_text(of_rough).find("places alone") != std::string::npos);
}

TEST_CASE("a body of planes needs no more triangles than it has", "[curved]") {
    Probe p = probe(
        std::make_shared<Mesh const>(make_mesh(box_soup({-1e-3, -2e-3, -3e-3}, {1e-3, 2e-3, 3e-3}))), 1e-8);
    Value const fits = mesh_fits(p.scene, p.optics, p.emission, p.options);
    Value const& levels = *fit_of(fits).find("levels");
    for (Value const& one : std::get<Array>(levels.data)) {
        CHECK(std::get<double>(one.find("bound_rad")->data) < 1e-11);
        CHECK(std::holds_alternative<std::monostate>(one.find("triangles_for_tolerance")->data));
    }
    CHECK(std::get<std::string>(fit_of(fits).find("fastest_within")->data) == "recognised");
}

TEST_CASE("the steps in which a file has its numbers are told by them", "[curved]") {
    std::vector<dvec3> decimals, floats, doubles;
    for (std::uint64_t i = 0; i < 100; ++i) {
        dvec3 const v(uniform(3, i, 0, 0), uniform(3, i, 0, 1), 12.0 * uniform(3, i, 0, 2));
        doubles.push_back(v);
        floats.push_back(as_float(v));
        decimals.push_back(glm::round(v * 1e5) / 1e5);
    }
    CHECK(steps_of(floats).floats);
    CHECK(!steps_of(decimals).floats);
    CHECK(steps_of(decimals).even == Approx(1e-5));
    CHECK(!steps_of(doubles).floats);
    CHECK(steps_of(doubles).even == 0.0);
}

TEST_CASE("a model alone is checked for its fineness by light that goes through it", "[curved]") {
    std::string const model = std::string(SAHL_SOURCE_DIR) + "/models/ball-1280.glb";
    Value const report = check_model(model, 1e-4);
    Table const& models = std::get<Table>(report.find("fit")->find("models")->data);
    REQUIRE(models.size() == 1);
    CHECK(std::get<std::string>(models.front().second.find("fastest_within")->data) == "recognised");
    CHECK(check_text(report).find("the fastest within 0.0001 rad: recognised") != std::string::npos);
    CHECK(!check_model(model).find("fit"));
}

TEST_CASE("an export in fewer triangles says how many, and stands for the same ball", "[curved]") {
    TemporaryFolder const folder("decimate");
    auto const ball = [&](std::string const& model) {
        return load_experiment(folder.write(
            "ball.toml",
            "title = \"a ball\"\n[trace]\nmin_power = 0.5\n[medium]\nglass = {n = 1.5}\n[[object]]\nname = "
            "\"ball\"\nmedium = \"glass\"\n" +
                model +
                "\n[[source]]\nname = \"beam\"\nbeam = {from_mm = [0, 0, -20], toward = [0, 0, 1], "
                "radius_mm = 4, pattern = \"hexagonal\", rays = 300}\n"));
    };
    std::string const fine = "model = \"" + std::string(SAHL_SOURCE_DIR) + "/models/ball-20480.glb\"";
    auto const lines = export_model(ball(fine), 120, folder.path / "fewer.glb", 2e-5);
    REQUIRE(lines.size() == 1);
    CHECK(lines.front().find("in place of 20480;") != std::string::npos);
    Value const summary = run_experiment(ball("model = \"fewer.glb\""), {}).summary;
    Value const& triangles = *summary.find("models")->find("ball")->find("triangles");
    CHECK(std::get<std::int64_t>(triangles.data) < 5000);
    CHECK(lines.front().starts_with("ball: " + std::to_string(std::get<std::int64_t>(triangles.data)) +
                                    " triangles in "));
    // what stays is as it was: still the ball's places and normals
    CHECK(std::get<std::string>(summary.find("objects")->find("ball")->find("method")->data) == "recognised");
    auto const larger = export_model(ball(fine + "\nscale = 2"), 120, folder.path / "larger.glb", 4e-5);
    CHECK(larger.front().substr(0, larger.front().find(';')) ==
          lines.front().substr(0, lines.front().find(';'))); // the tolerance is one of the world
}

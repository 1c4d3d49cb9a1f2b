// Meshes finer than a tolerance needs, traced in fewer triangles: is what the summary says of that true for
// rays that the pilots did not see?
#include "run/choice_scenes.h"
#include "run/decimation.h"
#include "run/method_choice.h"
#include "support/bench.h"
#include "support/catch.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

struct Stage {
    Scene exact, scene;
    WavelengthTable optics;
    Emission emission;
    TraceOptions options;
    std::vector<std::uint64_t> unseen;

    Stage(Pair const& pair, double beam_radius, double tolerance)
        : exact(made(pair, beam_radius, true)), scene(made(pair, beam_radius, false)), optics(exact),
          emission(exact.sources, optics, 1), unseen(spread_rays(emission, 900, 0.77)) {
        options.tolerance = tolerance;
        options.min_power = 1e-3;
    }
    static Scene made(Pair const& pair, double beam_radius, bool exact) {
        Lab lab;
        MediumId const glass = lab.medium(pair.index);
        lab.source(slanting_beam(beam_radius, 1500));
        if (exact)
            lab.body("body", pair.shape, glass, pair.place);
        Scene scene = build_scene(lab.experiment);
        return exact ? std::move(scene) : with_meshes(std::move(scene), {{"body", pair.mesh, glass, {}, 0}});
    }
    Trees trees(Scene const& of) const { return trees_of(of, optics, emission, options, unseen); }
};

} // namespace

TEST_CASE("auto traces a mesh finer than the tolerance needs in fewer triangles, and its bound holds",
          "[curved][slow]") {
    Pair const fine = ellipsoid(50, true, 0.4);
    for (double const tolerance : {2e-4, 1e-3, 3e-2}) {
        Stage stage(fine, 2e-3, tolerance);
        stage.options.decimate = true;
        MethodChoice const choice = choose_methods(stage.scene, stage.optics, stage.emission, stage.options);
        Body const& body = stage.scene.bodies.front();
        REQUIRE(choice.bodies.front().bound);
        double const bound = *choice.bodies.front().bound;
        std::size_t const left = body.mesh->soup.triangles.size(), all = fine.mesh->soup.triangles.size();
        PathErrors const errors = compare_paths(stage.trees(stage.scene), stage.trees(stage.exact), false);
        WARN(tolerance << ": " << name_of(body.method) << ", " << left << " of " << all
                       << " triangles, bound " << bound << ", greatest " << errors.greatest);
        CHECK(choice.warnings.empty());
        CHECK(bound <= tolerance);
        CHECK(share_above(errors, bound) <= 1e-3);
        REQUIRE(body.decimated);
        CHECK(body.decimated->whole == fine.mesh);
        CHECK(body.decimated->turn <= bound);
        CHECK(2 * left < all);
    }
}

TEST_CASE("a mesh is decimated by no more than an object asks for, and how far that turns light is told",
          "[curved]") {
    Pair const fine = ellipsoid(30, true, 0.4);
    for (Method const method : {Method::facet, Method::interpolated, Method::fitted}) {
        Stage stage(fine, 2e-3, 1e-6);
        stage.options.method = method;
        Body& body = stage.scene.bodies.front();
        body.method = method;
        stage.scene.bvh = bvh_with(stage.scene, std::vector{body_method(method)});
        Trees const before = stage.trees(stage.scene);
        body.decimate = 1e-5;
        CHECK(decimate_by_name(stage.scene, stage.optics, stage.emission, stage.options).empty());
        REQUIRE(body.decimated);
        PathErrors const moved = compare_paths(stage.trees(stage.scene), before, true);
        WARN(name_of(method) << ": " << body.mesh->soup.triangles.size() << " of "
                             << fine.mesh->soup.triangles.size() << ", turns light by "
                             << body.decimated->turn << ", greatest " << moved.greatest);
        CHECK(body.mesh->soup.triangles.size() < fine.mesh->soup.triangles.size());
        CHECK(body.decimated->within == 1e-5);
        CHECK(moved.greatest > 0.0);
        CHECK(share_above(moved, body.decimated->turn) <= 1e-3);
    }
}

TEST_CASE("a mesh that touches another keeps its triangles, and nothing is decimated unasked", "[curved]") {
    Lab lab;
    MediumId const glass = lab.medium(1.5), flint = lab.medium(1.7);
    lab.rays({{{1e-4, 2e-4, -1.0}, {0, 0, 1}, 1.0}});
    auto const block = [](double low, double high) {
        return std::make_shared<Mesh const>(make_mesh(box_soup({-1e-2, -1e-2, low}, {1e-2, 1e-2, high})));
    };
    Scene scene = with_meshes(build_scene(lab.experiment), {{"one", block(0.0, 1e-2), glass, {}, 0},
                                                            {"other", block(1e-2, 2e-2), flint, {}, 0}});
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, 1);
    TraceOptions options;
    settle_methods(scene, optics, emission, options);
    CHECK(!scene.bodies[0].decimated);
    scene.bodies[0].decimate = 1e-3;
    auto const warnings = decimate_by_name(scene, optics, emission, options);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0] == "one: it touches another body, and keeps its triangles");
    CHECK(!scene.bodies[0].decimated);
}

TEST_CASE("the summary and a check tell what a mesh was decimated to", "[curved]") {
    std::string const experiment = text(
        "[[object]]\nname = 'ball'\nmodel = '", SAHL_SOURCE_DIR,
        "/models/ball-5120.glb'\nmedium = 'N-BK7'\n"
        "decimate_mm = 0.02\n[[source]]\nname = 'beam'\nbeam = {from_mm = [0, 0, -50], toward = [0, 0, 1], "
        "radius_mm = 2, pattern = 'hexagonal', rays = 300}\n[trace]\nmethod = 'interpolated'\nmin_power = "
        "1e-3\n");
    Value const summary = summarise(experiment);
    CHECK(number_at(summary, {"objects", "ball", "decimated", "of"}) == 5120.0);
    CHECK(number_at(summary, {"objects", "ball", "decimated", "triangles"}) < 4000.0);
    CHECK(number_at(summary, {"objects", "ball", "decimated", "within_mm"}) == Approx(0.02).epsilon(1e-15));
    CHECK(number_at(summary, {"objects", "ball", "decimated", "turn_rad"}) > 0.0);
    CHECK(number_at(summary, {"models", "ball", "triangles"}) == 5120.0);
    CHECK(summarise(experiment, {"trace.method=auto"}).find("objects")->find("ball")->find("decimated"));
}

// Open meshes that are mirrors, as a modelling program writes them: met as the surface that they stand for,
// and judged by the exact mirror.
#include "geometry/curved_sheet.h"
#include "geometry/mesh_sheet.h"
#include "run/choice_scenes.h"
#include "run/export_model.h"
#include "run/method_choice.h"
#include "run/normal_warnings.h"
#include "scene/read_experiment.h"
#include "support/bench.h"
#include "support/catch.h"
#include "support/curved.h"
#include "support/dice.h"
#include "support/lathe.h"

#include <fstream>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr double vertex_radius = 0.1, rim = 0.04; // m

/// A paraboloid as an open mesh of `rings`, with the surface's own normals towards its hollow side.
std::shared_ptr<Mesh const> bowl(std::uint32_t rings, double rim_radius = rim) {
    std::vector<dvec2> outline;
    for (std::uint32_t i = 0; i <= rings; ++i) {
        double const r = rim_radius * i / rings;
        outline.push_back({r, 0.5 * r * r / vertex_radius});
    }
    return float_mesh(lathe_soup(outline, 6 * rings),
                      [](dvec3 const& p) { return normalize(dvec3(-p.x, -p.y, vertex_radius)); });
}

struct Compared {
    std::map<Method, PathErrors> by;
    MethodChoice choice;
    Method chosen_method = Method::automatic;
    PathErrors chosen;
    std::uint64_t lost = 0;
};

/// The same light on the exact mirror and on the mesh that is written of it.
Compared compared(std::string const& light, unsigned pieces, double tolerance) {
    Folder const folder;
    std::string const start =
        "[surface]\nsilver = {metal = 'silver'}\n[[object]]\nname = 'mirror'\nsurface = 'silver'\n";
    auto const put = [&](char const* name, std::string const& what) {
        std::ofstream(folder.path() / name) << start << what << light;
        return load_experiment(folder.path() / name);
    };
    ExperimentSource const exact_source =
        put("exact.toml", "shape = {conic_mirror = {radius_mm = 100, conic = -1, diameter_mm = 80}}\n");
    export_model(exact_source, pieces, folder.path() / "mirror.glb");
    ExperimentSource const mesh_source = put("mesh.toml", "model = 'mirror.glb'\n");
    Experiment const experiment = read_experiment(mesh_source.tree, mesh_source.file);
    Scene const exact = build_scene(read_experiment(exact_source.tree, exact_source.file));
    Scene scene = build_scene(experiment);
    REQUIRE(scene.bodies.front().open);
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, 1);
    TraceOptions options = experiment.trace;
    options.tolerance = tolerance;
    auto const rays = spread_rays(emission, 900, 0.77);
    Trees const truth = trees_of(exact, optics, emission, options, rays);
    Compared result;
    auto const judged = [&] {
        Trees const trees = trees_of(scene, optics, emission, options, rays);
        for (auto const& tree : trees)
            for (Segment const& segment : tree)
                result.lost += segment.ended == Event::leak || segment.ended == Event::invalid;
        return compare_paths(trees, truth, false);
    };
    for (Method const method : {Method::facet, Method::interpolated, Method::quadratic, Method::fitted}) {
        scene.bvh = bvh_with(scene, std::vector<BodyMethod>(scene.bodies.size(), body_method(method)));
        result.by[method] = judged();
    }
    result.choice = choose_methods(scene, optics, emission, options);
    result.chosen_method = scene.bodies.front().method;
    result.chosen = judged();
    return result;
}

std::string const on_axis =
    "[[source]]\nname = 'beam'\nbeam = {from_mm = [0.3, 0.2, 60], toward = [0.02, 0.01, -1], "
    "radius_mm = 32, pattern = 'hexagonal', rays = 1500}\n";

} // namespace

// 80 % of the aperture; `fitted` errs by what floats leave open, the others by their orders.
TEST_CASE("an open mesh as a mirror is met as the surface that it stands for", "[curved]") {
    Compared const coarse = compared(on_axis, 96, 1e-6), fine = compared(on_axis, 192, 1e-6);
    for (Compared const* run : {&coarse, &fine}) {
        for (auto const& [method, errors] : run->by)
            WARN(name_of(method) << ": RMS " << errors.rms << ", greatest " << errors.greatest
                                 << ", other events " << errors.changed_share());
        WARN("auto: " << name_of(run->chosen_method) << ", bound "
                      << run->choice.bodies.front().bound.value_or(-1.0) << ", greatest "
                      << run->chosen.greatest);
        CHECK(run->lost == 0);
        for (auto const& [method, errors] : run->by)
            CHECK(errors.changed == 0);
        REQUIRE(run->choice.bodies.front().bound);
        CHECK(share_above(run->chosen, *run->choice.bodies.front().bound) <= 1e-3);
        CHECK(run->by.at(Method::fitted).rms < 0.1 * run->by.at(Method::interpolated).rms);
    }
}

// Light that grazes round the hollow side, as in a whispering gallery, meets it again and again, never from
// behind; light from behind meets the bulging side once.
TEST_CASE("round the hollow of a curved mirror no light slips through it", "[curved]") {
    auto const mesh = bowl(24);
    CurvedSheet const sheet(mesh, PatchKind::fitted);
    Dice dice(3);
    std::size_t met = 0;
    for (int i = 0; i < 4000; ++i) {
        // from a place over the hollow, towards one on the surface well within the rim
        double const r = 0.9 * rim * std::sqrt(dice.uniform()), turn = dice.between(0.0, 6.3);
        dvec3 const aim(r * std::cos(turn), r * std::sin(turn), 0.5 * r * r / vertex_radius);
        dvec3 const from =
            aim + 0.05 * normalize(dice.direction() + normalize(dvec3(-aim.x, -aim.y, vertex_radius)));
        dvec3 const towards = normalize(aim - from);
        auto const hit = sheet.next(from, towards, {0.0, INFINITY}, 1e-17, {});
        if (!hit)
            continue; // it came over the rim
        ++met;
        double const across = std::hypot(hit->point.x, hit->point.y);
        if (across < 0.94 * rim) // within the last ring
            CHECK(std::abs(hit->point.z - 0.5 * across * across / vertex_radius) < 1e-8);
        dvec3 const mirrored = towards - 2.0 * dot(towards, hit->normal) * hit->normal;
        // on its way back it does not meet the place that it left
        auto const again = sheet.next(hit->point, mirrored, {0.0, INFINITY}, 1e-16, hit->enters);
        if (again)
            CHECK(again->t > 1e-9);
        auto const heads = sheet.heads_above(hit->point, mirrored, 1e-14);
        REQUIRE(heads);
        CHECK(*heads == hit->enters);
    }
    CHECK(met > 2000);
}

// The mesh's triangles and the surface between them part by the sag alone, so that both are met or missed but
// near the rim and the silhouette.
TEST_CASE("what meets the triangles of an open mesh meets its surface, and the reverse", "[curved]") {
    auto const mesh = bowl(20);
    CurvedSheet const sheet(mesh, PatchKind::fitted);
    MeshSheet const flat(mesh);
    double const sag = 0.5 * std::pow(rim / 20.0, 2) / vertex_radius;
    Dice dice(4);
    int compared_ones = 0;
    for (int i = 0; i < 4000; ++i) {
        dvec3 const from = 0.1 * dice.direction(),
                    to(dice.between(-rim, rim), dice.between(-rim, rim), dice.between(0.0, 8e-3));
        dvec3 const towards = normalize(to - from);
        auto const a = sheet.next(from, towards, {0.0, INFINITY}, 1e-17, {});
        auto const b = flat.next(from, towards, {0.0, INFINITY}, 1e-17, {});
        dvec3 const at = a ? a->point : b ? from + b->t * towards : dvec3(0.0);
        double const slope = a ? a->slope : b ? b->slope : 1.0;
        if (slope < 0.3 || std::hypot(at.x, at.y) > 0.97 * rim)
            continue;
        ++compared_ones;
        CHECK(a.has_value() == b.has_value());
        if (a && b)
            CHECK(std::abs(a->t - b->t) * slope < 4.0 * sag);
    }
    CHECK(compared_ones > 1000);
}

TEST_CASE("an open mesh that lies on another body keeps its triangles, and is said to", "[curved]") {
    Folder const folder;
    auto const write = [&](char const* name, std::string const& what) {
        std::ofstream(folder.path() / name) << what;
        return load_experiment(folder.path() / name);
    };
    std::string const surface = "[surface]\nsilver = {metal = 'silver'}\n", light = on_axis;
    std::string const face = "[[object]]\nname = 'mirror'\nsurface = 'silver'\n";
    export_model(write("a.toml", surface + face + "shape = {rectangle = {size_mm = [20, 20]}}\n" + light), 12,
                 folder.path() / "sheet.glb");
    ExperimentSource const source = write(
        "b.toml",
        surface + face + "model = 'sheet.glb'\n[[object]]\nname = 'block'\nmedium = 'N-BK7'\n" +
            "shape = {box = {size_mm = [30, 30, 10]}}\nmove_mm = [0, 0, -5]\n[trace]\nmethod = 'fitted'\n" +
            light);
    Scene const scene = build_scene(read_experiment(source.tree, source.file));
    CHECK(scene.bvh->curving(0) == Curving::none);
    CHECK(scene.bodies[0].method == Method::interpolated);
    auto const warnings = normal_warnings(scene);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].find("an open mesh that touches something") != std::string::npos);
}

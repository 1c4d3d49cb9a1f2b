// The example that shows every part of the format is read whole, and each of its values arrives in SI units.
#include "scene/read_experiment.h"

#include "materials/catalogue.h"
#include "scene/contract_example.h"
#include "scene/read_text.h"
#include "support/catch.h"

#include <limits>
#include <numbers>

using namespace sahl;

namespace {

/// The example where its file would lie, with the files it refers to.
struct Example {
    Example() {
        folder.write("models/bunny.obj", "v 0 0 0\n");
        folder.write("a/b/floor.png", "");
        folder.write("a/b/prism.toml", contract_example);
        std::string text;
        tree = read_experiment_file(file(), text);
        CHECK(text == contract_example);
        experiment = read_experiment(tree, file());
    }
    std::filesystem::path file() const { return folder.path / "a/b/prism.toml"; }

    TemporaryFolder folder;
    Value tree;
    Experiment experiment;
};

Medium const& medium_of(Experiment const& e, ObjectSpec const& object) {
    return e.media.at(object.medium.value().value);
}

} // namespace

TEST_CASE("the example of the format: title, options and limits are read") {
    Experiment const e = Example().experiment;
    CHECK(e.title == "A 60° prism at minimum deviation");
    CHECK(e.media.at(e.surroundings.value).name == find_glass("air")->name);
    CHECK(e.trace.max_depth == 64);
    CHECK(e.trace.min_power == 1e-6);
    CHECK(e.trace.branch == BranchPolicy::split);
    CHECK(e.trace.split_until == 0.1);
    CHECK(e.trace.method == Method::automatic);
    CHECK(e.trace.tolerance == 1e-6);
    CHECK(e.trace.tolerance_power == 1e-3);
    CHECK(e.trace.polarised == Polarised::automatic);
    CHECK(e.trace.seed == 1);
    CHECK(!e.log.on);
    CHECK(e.log.every == 1);
    CHECK(!e.log.compress);
    CHECK(e.limits.leak == 1e-6);
    CHECK(e.limits.ledger == 1e-12);
}

TEST_CASE("the example of the format: its prism has medium, face and size in metres") {
    Experiment const e = Example().experiment;
    REQUIRE(e.objects.size() == 2);
    ObjectSpec const& prism = e.objects[0];
    CHECK(prism.name == "prism");
    auto const& shape = std::get<Prism>(std::get<Shape>(prism.what));
    CHECK(shape.apex == Approx(std::numbers::pi / 3.0).epsilon(1e-15));
    CHECK(shape.side == 0.025);
    CHECK(shape.length == 0.025);
    CHECK(medium_of(e, prism).name == "flint");
    CHECK(refractive_index(medium_of(e, prism).index, 587.5618e-9) ==
          Approx(1.78472).margin(1e-5)); // SCHOTT N-SF11
    CHECK(!medium_of(e, prism).absorption.empty());
    REQUIRE(prism.faces.size() == 1);
    CHECK(prism.faces[0].first == "base");
    CHECK(e.surfaces.at(prism.faces[0].second.value).name == "wall");
    CHECK(!prism.surface);
    CHECK(prism.to_world == Affine{});
    CHECK(prism.priority == 0);
}

TEST_CASE("the example of the format: its model has path, unit and materials") {
    Example const example;
    Experiment const& e = example.experiment;
    ObjectSpec const& bunny = e.objects.at(1);
    auto const& model = std::get<ModelReference>(bunny.what);
    CHECK(std::filesystem::equivalent(model.path, example.folder.path / "models/bunny.obj"));
    CHECK(model.metres_per_unit == 1e-3);
    CHECK(model.parts == std::vector<std::string>{"*"});
    REQUIRE(model.materials.size() == 2);
    CHECK(model.materials[0].material == "Glass");
    CHECK(e.media.at(model.materials[0].medium.value().value).name == medium_of(e, bunny).name);
    CHECK(model.materials[1].material == "Mirror");
    CHECK(e.surfaces.at(model.materials[1].surface.value().value).name == "silver");
    CHECK(bunny.to_world.offset == dvec3(0.0, 0.0, 0.5));
    CHECK(e.media.size() == 3); // air, flint, N-BK7: only what something refers to
}

TEST_CASE("the example of the format: its five surfaces keep the order of the file") {
    Example const example;
    auto const& surfaces = example.experiment.surfaces;
    REQUIRE(surfaces.size() == 5);
    CHECK(surfaces[0].name == "silver");
    CHECK(std::get<Metal>(surfaces[0].kind).table.size() > 1);
    CHECK(std::get<Shares>(surfaces[1].kind).reflect == 0.5);
    CHECK(std::get<Shares>(surfaces[1].kind).transmit == 0.5);
    CHECK(std::holds_alternative<Absorber>(surfaces[2].kind));
    CHECK(std::get<Diffuse>(surfaces[3].kind).reflectance == 0.97);
    auto const& paint = std::get<Paint>(surfaces[4].kind);
    CHECK(paint.diffuse == std::array<double, 3>{0.8, 0.2, 0.2});
    CHECK(paint.specular == std::array<double, 3>{1.0, 1.0, 1.0});
    CHECK(paint.shininess == 40.0);
    CHECK(paint.reflect == 0.2);
    CHECK(std::filesystem::exists(paint.texture));
}

TEST_CASE("the example of the format: its laser, screen and sweep") {
    Experiment const e = Example().experiment;
    SourceSpec const& laser = e.sources.at(0);
    auto const& beam = std::get<Beam>(laser.emitter);
    CHECK(laser.name == "laser");
    CHECK(beam.from == dvec3(-0.05, 0.0, 0.0));
    CHECK(beam.toward == dvec3(1.0, 0.0, 0.0));
    CHECK(dot(beam.up, beam.toward) == 0.0);
    CHECK(beam.radius == 0.002);
    CHECK(beam.pattern == Pattern::hexagonal);
    CHECK(beam.rays == 1000);
    CHECK(!beam.gaussian_radius);
    CHECK(laser.power == 1.0);
    REQUIRE(laser.polarisation);
    CHECK(laser.polarisation->stokes == dvec3(1.0, 0.0, 0.0));
    CHECK(laser.polarisation->axis == dvec3(0.0, 1.0, 0.0));
    REQUIRE(laser.wavelengths.size() == 3);
    CHECK(laser.wavelengths[0] == std::pair{486.1327 * 1e-9, 1.0});
    CHECK(laser.wavelengths[2] == std::pair{656.2725 * 1e-9, 1.0});

    DetectorSpec const& screen = e.detectors.at(0);
    CHECK(screen.name == "screen");
    CHECK(screen.size == dvec2(0.08, 0.08));
    CHECK(screen.columns == 256);
    CHECK(screen.rows == 256);
    CHECK(screen.absorbs);
    CHECK(!screen.back);
    CHECK(screen.to_world.offset == dvec3(0.04, -0.06, 0.0));
    dmat3 const& axes = screen.to_world.linear;
    CHECK(length(axes[2] - normalize(dvec3(-0.4, 0.92, 0.0))) < 1e-15);
    CHECK(axes[1] == dvec3(0.0, 0.0, 1.0));
    CHECK(length(axes[0] - cross(axes[1], axes[2])) < 1e-15);

    REQUIRE(e.sweep.axes.size() == 1);
    CHECK(e.sweep.axes[0].key == "object.prism.turn_deg[2]");
    REQUIRE(e.sweep.runs() == 26);
    for (int i = 0; i < 26; ++i)
        CHECK(std::get<double>(e.sweep.point(static_cast<std::size_t>(i))[0].data) == -45.0 + i);
    CHECK(e.warnings.empty());
}

TEST_CASE("the example of the format reads the same as TOML and as JSON") {
    Example const example;
    Value const json = parse_json(to_json(example.tree), "prism.json");
    CHECK(to_json(json) == to_json(example.tree));
    Experiment const a = example.experiment, b = read_experiment(json, example.file());
    CHECK(a.title == b.title);
    CHECK(a.media.size() == b.media.size());
    for (std::size_t i = 0; i < a.media.size(); ++i) {
        CHECK(a.media[i].name == b.media[i].name);
        CHECK(a.media[i].absorption == b.media[i].absorption);
        CHECK(refractive_index(a.media[i].index, 5e-7) == refractive_index(b.media[i].index, 5e-7));
    }
    REQUIRE(a.surfaces.size() == b.surfaces.size());
    for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
        CHECK(a.surfaces[i].name == b.surfaces[i].name);
        CHECK(a.surfaces[i].kind.index() == b.surfaces[i].kind.index());
    }
    REQUIRE(a.objects.size() == b.objects.size());
    for (std::size_t i = 0; i < a.objects.size(); ++i) {
        CHECK(a.objects[i].name == b.objects[i].name);
        CHECK(a.objects[i].medium == b.objects[i].medium);
        CHECK(a.objects[i].faces == b.objects[i].faces);
        CHECK(a.objects[i].to_world == b.objects[i].to_world);
        CHECK(a.objects[i].what.index() == b.objects[i].what.index());
    }
    CHECK(a.sources.at(0).wavelengths == b.sources.at(0).wavelengths);
    CHECK(std::get<Beam>(a.sources[0].emitter).from == std::get<Beam>(b.sources[0].emitter).from);
    CHECK(std::get<Beam>(a.sources[0].emitter).rays == std::get<Beam>(b.sources[0].emitter).rays);
    CHECK(a.detectors.at(0).to_world == b.detectors.at(0).to_world);
    CHECK(a.detectors[0].columns == b.detectors[0].columns);
    REQUIRE(a.sweep.runs() == b.sweep.runs());
    for (std::size_t run = 0; run < a.sweep.runs(); ++run)
        CHECK(to_json(a.sweep.point(run)[0]) == to_json(b.sweep.point(run)[0]));
    CHECK(b.detectors[0].place.text() == "prism.json: /detector/0");
}

TEST_CASE("an experiment of one source has the declared defaults, which are those of the structures") {
    Experiment const e = read_text(one_source, "folder/lone.toml");
    TraceOptions const declared;
    CHECK(e.title == "lone");
    CHECK(e.trace.max_depth == declared.max_depth);
    CHECK(e.trace.min_power == declared.min_power);
    CHECK(e.trace.split_until == declared.split_until);
    CHECK(e.trace.split_depth == declared.split_depth);
    CHECK(e.trace.tolerance == declared.tolerance);
    CHECK(e.trace.tolerance_power == declared.tolerance_power);
    CHECK(e.trace.seed == declared.seed);
    CHECK(e.log.on == LogOptions().on);
    CHECK(e.log.every == LogOptions().every);
    CHECK(e.limits.leak == Limits().leak);
    CHECK(e.limits.ledger == Limits().ledger);
    CHECK(e.sources.at(0).wavelengths == std::vector<std::pair<double, double>>{{587.5618 * 1e-9, 1.0}});
    CHECK(e.sources[0].power == 1.0);
    CHECK(std::get<Beam>(e.sources[0].emitter).rays == 1);
}

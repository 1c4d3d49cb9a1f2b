// Models that several scenes share: read once, prepared once, and traced as if each scene had its own.
#include "support/catch.h"
#include "support/gltf.h"

#include "run/run.h"
#include "scene/model_cache.h"
#include "scene/read_model.h"
#include "scene/scene.h"

using namespace sahl;
using namespace sahl::bench;
namespace fs = std::filesystem;

namespace {

fs::path model(std::string const& name) {
    return fs::path(SAHL_SOURCE_DIR) / "models" / name;
}

std::string experiment(fs::path const& file, std::string const& more) {
    return "title = \"It\"\n[[object]]\nname = \"it\"\nmodel = \"" + file.string() +
           "\"\nmedium = \"N-BK7\"\n" +
           "[[source]]\nname = \"beam\"\nbeam = {from_mm = [0, 0, -10], toward = [0, 0, 1], radius_mm = 4, "
           "rays = "
           "40}\n[[detector]]\nname = \"screen\"\nat_mm = [0, 0, 8]\nfacing = [0, 0, -1]\nsize_mm = [4, "
           "4]\npixels "
           "= [4, 4]\n" +
           more;
}

} // namespace

TEST_CASE("scenes that share a cache share a model's meshes and what is made of them", "[scene]") {
    ModelCache cache;
    Experiment const described = read_experiment(
        parse_toml(experiment(model("ball-320.glb"), ""), "cache.toml"), fs::current_path() / "cache.toml");
    Scene const one = build_scene(described, &cache), other = build_scene(described, &cache),
                alone = build_scene(described);
    CHECK(one.bodies[0].mesh == other.bodies[0].mesh);
    CHECK(one.meshes->tree(one.bodies[0].mesh) == other.meshes->tree(other.bodies[0].mesh));
    CHECK(one.bodies[0].mesh != alone.bodies[0].mesh);
    // two bodies of one mesh, cut apart
    std::shared_ptr<Model const> const rod = cache.model(model("clad-rod.gltf"));
    auto const mesh = cache.mesh(rod, 0);
    CHECK(cache.part(mesh, {0}) == cache.part(mesh, {0}));
}

TEST_CASE("a model file that changes is read again, and the longest unused is given up", "[scene]") {
    TemporaryFolder const folder("cache");
    fs::path const file = folder.path / "it.glb";
    fs::copy_file(model("ball-320.glb"), file);
    ModelCache cache(1500);
    auto const first = cache.model(file);
    CHECK(cache.model(file) == first);
    fs::copy_file(model("ball-1280.glb"), file, fs::copy_options::overwrite_existing);
    auto const second = cache.model(file);
    CHECK(second->meshes[0].soup.triangles.size() == 1280);
    CHECK(first->meshes[0].soup.triangles.size() == 320); // who has it keeps it
    cache.model(model("ball-320.glb"));                   // more than are kept
    CHECK(cache.model(file) != second);
    auto const lost = cache.model(model("prism.gltf"));
    cache.model(file);
    cache.model(model("singlet-504.glb"));
    CHECK(cache.mesh(lost, 0)->triangle_shell.size() == 8); // though it was given up
}

TEST_CASE("the steps of a sweep see a model as runs of their own do", "[scene]") {
    TemporaryFolder const folder("cache-sweep");
    RunOptions options;
    options.out = folder.path / "out";
    std::string const sweep = "[sweep]\n\"object.it.move_mm[2]\" = [0, 0.5, 1]\n";
    run_experiment(load_experiment(folder.write("sweep.toml", experiment(model("ball-1280.glb"), sweep))),
                   options);
    auto const text = [](fs::path const& name) {
        std::ifstream in(name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    fs::path const plain = folder.write("plain.toml", experiment(model("ball-1280.glb"), ""));
    for (int k = 0; k < 3; ++k) {
        options.out = folder.path / ("run" + std::to_string(k));
        run_experiment(load_experiment(plain, {"object.it.move_mm[2]=" + std::to_string(0.5 * k)}), options);
        std::string const run = "out/runs/00" + std::to_string(k) + "/";
        for (char const* name : {"detectors/screen.csv", "detectors/screen.exr"})
            CHECK(text(folder.path / run / name) == text(options.out / name));
        auto const models = [&](fs::path const& at) {
            return to_json(*parse_json(text(at / "summary.json"), "summary.json").find("models"));
        };
        CHECK(models(folder.path / run) == models(options.out));
    }
}

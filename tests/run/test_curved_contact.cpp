// A cemented doublet as two meshes in frames of their own, each met as curved: between them there is no gap.
#include "run/export_model.h"
#include "run/run.h"
#include "support/catch.h"
#include "support/gltf.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

std::string const head = "title = \"doublet\"\n[trace]\nmethod = \"METHOD\"\n[medium]\ncrown = {n = 1.5168}\n"
                         "flint = {n = 1.67271}\n";
std::string const lenses =
    "[[object]]\nname = \"crown lens\"\nmedium = \"crown\"\n"
    "shape = {lens = {r1_mm = 61.47, r2_mm = -44.64, thickness_mm = 6, diameter_mm = 25}}\n"
    "[[object]]\nname = \"flint lens\"\nmedium = \"flint\"\nmove_mm = [0, 0, 6]\n"
    "shape = {lens = {r1_mm = -44.64, r2_mm = -129.94, thickness_mm = 2.5, diameter_mm = 25}}\n";
std::string const light =
    "[[source]]\nname = \"beam\"\nbeam = {from_mm = [0, 0, -10], toward = [0, 0, 1], radius_mm = 10, "
    "pattern = \"hexagonal\", rays = 400}\n"
    "[[detector]]\nname = \"screen\"\nat_mm = [0, 0, 105]\nfacing = [0, 0, -1]\nup = [0, 1, 0]\nsize_mm = "
    "[4, 4]\n";

Value traced(TemporaryFolder const& folder, std::string const& objects, std::string const& method) {
    std::string text = head + objects + light;
    text.replace(text.find("METHOD"), 6, method);
    return run_experiment(load_experiment(folder.write("doublet.toml", text)), {}).summary;
}

} // namespace

TEST_CASE("between two curved meshes that are cemented there is no gap", "[curved][run]") {
    TemporaryFolder const folder("curved-doublet");
    std::string shapes = head + lenses + light;
    shapes.replace(shapes.find("METHOD"), 6, "auto");
    export_model(load_experiment(folder.write("shapes.toml", shapes)), 96, folder.path / "doublet.glb");
    auto const figure = [](Value const& summary, std::initializer_list<char const*> keys) {
        Value const* at = &summary;
        for (char const* const key : keys)
            at = at->find(key);
        return *at;
    };
    Value const exact = traced(folder, lenses, "auto");
    for (char const* const method : {"quadratic", "fitted", "recognised", "auto"}) {
        INFO(method);
        Value const mesh = traced(folder, "[[object]]\nname = \"all\"\nmodel = \"doublet.glb\"\n", method);
        // a gap, however thin, would reflect some of it
        CHECK(std::get<double>(figure(mesh, {"detectors", "screen", "power_W"}).data) ==
              Approx(std::get<double>(figure(exact, {"detectors", "screen", "power_W"}).data)).epsilon(1e-9));
        CHECK(std::get<std::int64_t>(figure(mesh, {"segments"}).data) ==
              std::get<std::int64_t>(figure(exact, {"segments"}).data));
        CHECK(std::get<std::int64_t>(figure(mesh, {"events", "leak"}).data) == 0);
    }
}

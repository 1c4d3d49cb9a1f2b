// What is wrong with a glTF file and cannot change the light is told, and the file is read; what is kept for
// pictures is checked.
#include "math/input_error.h"
#include "scene/read_gltf.h"
#include "support/catch.h"
#include "support/gltf.h"
#include "support/lab.h"
#include "support/meshes.h"

#include <algorithm>
#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

std::string const paint = R"([{"name": "Wall", "pbrMetallicRoughness": {"metallicFactor": 0}}])";

/// A cube with nodes and further entries of the file.
Model read(TemporaryFolder const& folder, std::string const& nodes, std::string const& more) {
    return read_gltf(
        folder.write("model.gltf", gltf_text({box_soup(dvec3(-1.0), dvec3(1.0))}, paint, nodes, more)));
}

std::size_t warnings_of(Model const& model, std::string const& part) {
    return static_cast<std::size_t>(
        std::count_if(model.warnings.begin(), model.warnings.end(),
                      [&](std::string const& warning) { return warning.find(part) != std::string::npos; }));
}

} // namespace

TEST_CASE("cameras and lights of nodes are kept with their places, and wrong ones left out with a warning",
          "[scene]") {
    TemporaryFolder const folder("faults");
    Model const model = read(
        folder,
        R"([{"mesh": 0, "children": [1, 2, 3]}, {"name": "eye", "camera": 0, "translation": [0, 0, 5]}, {"camera": 1},
            {"name": "lamp", "translation": [1, 2, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}}])",
        R"(, "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}},
                          {"type": "perspective", "perspective": {"yfov": 0, "znear": 0.1}}],
            "extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual": {"lights": [
            {"type": "spot", "intensity": 3, "spot": {"outerConeAngle": 0.5}},
            {"type": "spot", "spot": {"innerConeAngle": 1, "outerConeAngle": 0.5}}]}})");
    REQUIRE(model.cameras.size() == 1);
    CHECK(model.cameras[0].name == "eye");
    CHECK(model.cameras[0].yfov == 0.5);
    CHECK(model.cameras[0].to_world.offset == dvec3(0.0, 0.0, 5.0));
    REQUIRE(model.lights.size() == 1);
    CHECK(model.lights[0].intensity == 3.0);
    CHECK(model.lights[0].to_world.offset == dvec3(1.0, 2.0, 3.0));
    CHECK(warnings_of(model, "/cameras/1/perspective/yfov: 0 is not above 0") == 1);
    CHECK(warnings_of(model, "/extensions/KHR_lights_punctual/lights/1/spot") == 1);
    CHECK(warnings_of(model, "1 camera and 1 light are kept for pictures") == 1);
}

TEST_CASE(
    "faults that no light can meet are told one by one with their places, and no file makes many of them",
    "[scene]") {
    TemporaryFolder const folder("faults");
    Model const model = read(
        folder, R"([{"mesh": 0, "extras": {"id": 7}}, {"children": [2]}, {"children": [1], "skin": 4}])",
        R"(, "scenes": [{"nodes": [0]}, {"nodes": [9]}], "textures": {}, "animations": [], "extras": [1, 2],
                "extensions": {"EXT_a": 1}, "extensionsUsed": ["EXT_b", "EXT_b"])");
    for (char const* const place :
         {"/textures: this must be an array", "/animations: it is empty",
          "/extensions/EXT_a: this must be an object", "/extensions/EXT_a: extensionsUsed does not name",
          "/extensionsUsed/1: this extension is named twice", "/nodes/2/skin: there is no such skin",
          "/scenes/1/nodes/0: there is no such node", "its children lead back to it"}) {
        CAPTURE(place);
        CHECK(warnings_of(model, place) >= 1);
    }
    CHECK(model.instances.size() == 1);
    REQUIRE(model.instances[0].node);
    CHECK(model.instances[0].node->extras == "{\n  \"id\": 7\n}");
    CHECK(model.extras == "[1, 2]");

    std::string many = "[0";
    for (int i = 0; i < 3000; ++i)
        many += ", 77";
    CHECK(read(folder, R"([{"mesh": 0}])", R"(, "scenes": [{"nodes": [0]}, {"nodes": )" + many + "]}]")
              .warnings.size() < 300);
}

TEST_CASE("long names are cut, since each instance and face has them", "[scene]") {
    TemporaryFolder const folder("faults");
    std::string const name = std::string(198, 'x') + "ééé";
    Model const model = read(folder, R"([{"mesh": 0, "name": ")" + name + "\"}]", "");
    CHECK(model.instances[0].name == std::string(198, 'x') + "é");
}

TEST_CASE("instances of one mesh share it in the scene, whatever their number", "[scene]") {
    TemporaryFolder const folder("faults");
    std::string nodes = R"([{"mesh": 0})";
    for (int i = 1; i < 200; ++i)
        nodes += R"(, {"mesh": 0, "translation": [)" + std::to_string(3 * i) + ", 0, 0]}";
    Lab lab;
    ModelReference reference;
    reference.path =
        folder.write("model.gltf", gltf_text({box_soup(dvec3(-1.0), dvec3(1.0))}, paint, nodes + "]"));
    lab.experiment.objects.push_back({"boxes", reference, {}, {}, {}, {}, 0, {}});
    lab.rays({{{300.0, 0.3, 5.0}, {0.0, 0.0, -1.0}}});
    Traced const traced = trace(lab);
    REQUIRE(traced.scene.bodies.size() == 200);
    for (Body const& body : traced.scene.bodies)
        CHECK(body.mesh == traced.scene.bodies[0].mesh);
    CHECK(traced.ended(Event::absorbed) == 1);
    CHECK(traced.segments()[0].length == Approx(4.0).epsilon(1e-14));
}

// Cameras and lights of glTF files as a picture takes them.
#include "render/lamps.h"
#include "run/render.h"
#include "scene/model_picture.h"
#include "support/bench.h"
#include "support/catch.h"
#include "support/gltf.h"

#include <cmath>
#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// Twice as large, a quarter turn about y (−z goes to −x), and moved.
Affine const place{dmat3(dvec3(0, 0, -2), dvec3(0, 2, 0), dvec3(2, 0, 0)), dvec3(1, 2, 3)};

} // namespace

TEST_CASE("a glTF camera looks along -z of its node, with its angle and its shape of picture", "[scene]") {
    ModelCamera from;
    from.to_world = {dmat3(1.0), dvec3(0, 0, 5)};
    from.yfov = 0.7;
    from.aspect = 2.0;
    Camera const camera = camera_of(from, place);
    CHECK(length(camera.at - dvec3(11, 2, 3)) < 1e-15);
    CHECK(length(camera.forward - dvec3(-1, 0, 0)) < 1e-15);
    CHECK(length(camera.up - dvec3(0, 1, 0)) < 1e-15);
    CHECK(camera.fov == 0.7);
    CHECK((camera.columns == 960 && camera.rows == 480));
    from.aspect = 0.5;
    CHECK((camera_of(from, place).columns == 640 && camera_of(from, place).rows == 1280));
    from.aspect = 0.0;
    CHECK((camera_of(from, place).columns == 640 && camera_of(from, place).rows == 480));
    from.perspective = false;
    from.xmag = 3.0;
    from.ymag = 1.5;
    Camera const flat = camera_of(from, place);
    CHECK((flat.fov == 0.0 && std::abs(flat.height - 6.0) < 1e-15));
    CHECK((flat.columns == 960 && flat.rows == 480));
}

TEST_CASE("a lamp of pi candela makes what faces it at a metre white, whatever the node's scale", "[scene]") {
    ModelLight from;
    from.intensity = std::numbers::pi;
    from.color = {1.0, 0.5, 0.25};
    from.inner_cone = 0.1;
    from.outer_cone = 0.4;
    Light const point = light_of(from, place);
    CHECK(std::get<PointLight>(point.kind).at == dvec3(1, 2, 3));
    CHECK(length(point.intensity - dvec3(1.0, 0.5, 0.25)) < 1e-15);
    CHECK(point.falloff == 1.0);
    from.kind = ModelLight::Kind::spot;
    auto const spot = std::get<SpotLight>(light_of(from, place).kind);
    CHECK(length(spot.toward - dvec3(-1, 0, 0)) < 1e-15);
    CHECK((spot.inner == 0.1 && spot.outer == 0.4));
    from.kind = ModelLight::Kind::directional;
    Light const sun = light_of(from, place);
    CHECK(length(std::get<DirectionalLight>(sun.kind).toward - dvec3(-1, 0, 0)) < 1e-15);
    CHECK(sun.falloff == 0.0);
}

TEST_CASE("candelas and luxes light as KHR_lights_punctual has them, a spot by its two cones", "[scene]") {
    ModelLight from;
    from.kind = ModelLight::Kind::spot;
    from.intensity = 10.0; // cd
    from.inner_cone = 0.2;
    from.outer_cone = 0.5;
    Light const spot = light_of(from, {});
    double const pi = std::numbers::pi;
    auto const at = [&](double angle) { return 2.0 * dvec3(std::sin(angle), 0.0, -std::cos(angle)); };
    // E = I / d² lx, and white shows E / π; between the cones the square of a line in the cosine
    double const between =
        (std::cos(0.35) - std::cos(0.5)) / (std::cos(0.2) - std::cos(0.5)); // 0.6004 of the line
    CHECK(view_of(spot, at(0.1)).light.x == Approx(10.0 / 4.0 / pi).epsilon(1e-12));
    CHECK(view_of(spot, at(0.35)).light.x == Approx(10.0 / 4.0 / pi * between * between).epsilon(1e-12));
    CHECK(view_of(spot, at(0.51)).light.x == 0.0);
    from.kind = ModelLight::Kind::directional;
    from.intensity = 5.0; // lx, at any distance
    CHECK(view_of(light_of(from, {}), at(0.35)).light.x == Approx(5.0 / pi).epsilon(1e-12));
}

TEST_CASE("an experiment without camera and lamps is seen by its model's camera, in the light of its lamps",
          "[scene]") {
    // the camera's node is two metres before a square of a metre, and a lamp of pi candela a metre before it
    TriangleSoup soup;
    soup.positions = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}};
    TemporaryFolder const folder("model_picture");
    folder.write(
        "m.gltf",
        gltf_text({soup}, R"([{"name": "White", "pbrMetallicRoughness": {"metallicFactor": 0}}])",
                  R"([{"mesh": 0}, {"camera": 0, "translation": [0, 0, 2]},
                               {"translation": [0, 0, 1], "extensions": {"KHR_lights_punctual": {"light": 0}}}])",
                  R"(, "cameras": [{"type": "perspective", "perspective": {"yfov": 0.05, "znear": 0.1,
                           "aspectRatio": 1.5}}], "extensionsUsed": ["KHR_lights_punctual"], "extensions":
                           {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 3.141592653589793}]}})"));
    auto const toml =
        folder.write("e.toml", "[[object]]\nname = \"m\"\nmodel = \"m.gltf\"\nmove_mm = [0, 70, 0]\n");
    RenderOptions options;
    options.files = {folder.path / "m.png"};
    RenderResult const result = render_experiment(load_experiment(toml, {"picture.filter=\"box\""}), options);
    CHECK(number_at(result.summary, {"columns"}) == 720);
    Image const image = read_image(folder.path / "m.png");
    // all of it is within 0.05 m of the middle, where the lamp's light falls as cos^3: to 0.996 and, encoded,
    // 0.998
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (image.pixels[i] < 0.99F) {
            CAPTURE(i);
            CHECK(image.pixels[i] > 0.99F);
            break;
        }
}

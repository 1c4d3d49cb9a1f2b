// Glass whose base colour is a picture, as glTF's KHR_materials_transmission has it.
#include "image/image.h"
#include "run/render_scene.h"
#include "scene/read_text.h"
#include "support/catch.h"
#include "support/gltf.h"

#include <cmath>

using namespace sahl;

namespace {

/// A plate of n = 1.5 whose surfaces have a picture of one colour, before a white wall, looked at head on, or
/// in the way of the only lamp of the wall.
dvec3 seen_through(decltype(Surface::kind) const& kind, std::string const& more, bool pictured = true) {
    bench::TemporaryFolder const folder("textured_glass");
    write_image(folder.path / "colour.exr", {1, 1, 3, {0.5F, 0.25F, 1.0F}});
    Experiment experiment =
        read_text("[surface.white]\npaint = {ambient = [1, 1, 1], diffuse = [1, 1, 1]}\n"
                  "[surface.glass]\nreflect = 0.5\n[[object]]\nname = \"wall\"\n"
                  "shape = {rectangle = {size_mm = [400, 400]}}\nsurface = \"white\"\nmove_mm = [0, 0, -50]\n"
                  "[[object]]\nname = \"plate\"\nshape = {box = {size_mm = [40, 40, 5]}}\nmedium = \"m\"\n"
                  "surface = \"glass\"\n[medium.m]\nn = 1.5\n[trace]\nmin_power = 1e-9\n"
                  "[camera]\nat_mm = [0, 0, 100]\nlook_at_mm = [0, 0, 0]\nheight_mm = 1e-6\n"
                  "resolution = [1, 1]\nsamples = 1\n" +
                  more);
    Scene scene = build_scene(experiment);
    TextureSource source;
    source.file = folder.path / "colour.exr";
    scene.textures.push_back(source);
    for (Surface& surface : scene.surfaces)
        if (surface.name == "glass") {
            surface.kind = kind;
            if (pictured)
                surface.texture = TextureId{0};
        }
    PictureMaker const maker(scene, *experiment.picture, experiment.trace);
    std::atomic<bool> const never{false};
    Film const film = render_scene(maker, experiment.picture->options, 1, {}, never).film;
    return film.mean(film.at(0, 0));
}

void check_colour(dvec3 const& seen, dvec3 const& expected) {
    for (int c = 0; c < 3; ++c)
        CHECK(seen[c] == Approx(expected[c]).epsilon(1e-6));
}

} // namespace

TEST_CASE("a picture on glass tints what goes through each surface, and nothing that is reflected",
          "[render]") {
    dvec3 const colour(0.5, 0.25, 1.0);
    // T² of 0.96 each, and what was reflected to and fro in between, untinted: 1 + 0.04² + 0.04⁴ …
    dvec3 const plate = 0.96 * 0.96 / (1.0 - 0.04 * 0.04) * colour * colour;
    check_colour(seen_through(Tinted{}, ""), plate);
    std::string const by_lines = "[picture]\nwavelengths = 6\n"; // where colours hold over bands
    check_colour(seen_through(Tinted{}, by_lines),
                 seen_through(Tinted{1.0, {0.5, 0.25, 1.0}, {}}, by_lines, false));
    // of a metal it tints what is mirrored: of the white sky, and nothing of the wall
    check_colour(seen_through(Tinted{0.0, {1, 1, 1}, {0.8, 0.8, 0.8}}, "[background]\ncolor = [1, 1, 1]\n"),
                 0.8 * colour);
}

TEST_CASE("a picture on glass tints the light that casts its shadow", "[render]") {
    dvec3 const colour(0.5, 0.25, 1.0);
    std::string const from_the_side =
        "[[light]]\ndirectional = {toward = [0, 0, -1]}\n[picture]\nambient = [0, 0, 0]\n";
    // seen through the plate again; the lamp's light goes straight through both surfaces, once
    dvec3 const straight = 0.96 * 0.96 * colour * colour;
    check_colour(seen_through(Tinted{}, from_the_side),
                 straight * 0.96 * 0.96 / (1.0 - 0.04 * 0.04) * colour * colour);
}

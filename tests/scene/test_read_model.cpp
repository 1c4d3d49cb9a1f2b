// Models of either format in an experiment: told apart by their endings, scaled by their length unit.
#include "math/input_error.h"
#include "scene/read_model.h"
#include "scene/read_text.h"
#include "scene/scene.h"
#include "support/catch.h"

using namespace sahl;

namespace {

/// A box of the size 4 × 2 × 1 at the origin, and a tetrahedron beside it, of two kinds of glass.
char const two_bodies[] = R"(mtllib two.mtl
o box
v 0 0 0
v 4 0 0
v 4 2 0
v 0 2 0
v 0 0 1
v 4 0 1
v 4 2 1
v 0 2 1
usemtl crown
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
o tip
g sharp
v 6 0 0
v 7 0 0
v 6 1 0
v 6 0 1
usemtl flint
f 9 11 10
f 9 10 12
f 10 11 12
f 11 9 12
)";

Scene scene_with(TemporaryFolder const& folder, std::string const& keys) {
    folder.write("two.obj", two_bodies);
    folder.write("two.mtl", "newmtl crown\nillum 7\nNi 1.5\nnewmtl flint\nillum 7\nNi 1.7\n");
    std::string const text =
        "[[object]]\nname = \"m\"\nmodel = \"two.obj\"\n" + keys + "\n" + std::string(one_source);
    return build_scene(read_text(text, folder.path / "x.toml"));
}

double index_of(Scene const& scene, std::size_t body) {
    return refractive_index(scene.media[scene.bodies[body].medium.value].index, 587.5618e-9);
}

} // namespace

TEST_CASE("a model is told by its ending, in capitals or not") {
    for (char const* name : {"a.obj", "a.OBJ", "a/b.glb", "a.GlTF"})
        CHECK(is_model_file(name));
    for (char const* name : {"a.toml", "obj", "a.obj.toml", "a", ".obj", "a.mtl"})
        CHECK_FALSE(is_model_file(name));
    for (char const* name : {"a.stl", "a.PLY", "b/a.blend"}) {
        CHECK_FALSE(is_model_file(name));
        CHECK(is_foreign_model_file(name));
    }
    for (char const* name : {"a.toml", "a.json", "a", "a.glb"})
        CHECK_FALSE(is_foreign_model_file(name));
    CHECK(error_of([] { read_model("a.stl"); }).find("give a .gltf, .glb or .obj file") != std::string::npos);
}

TEST_CASE("OBJ bodies in an experiment have the length unit and the file's glasses") {
    TemporaryFolder const folder;
    Scene const scene = scene_with(folder, "length_unit = \"cm\"");
    REQUIRE(scene.bodies.size() == 2);
    CHECK(scene.bodies[0].name == "m.box");
    CHECK(scene.bodies[1].name == "m.tip");
    CHECK(index_of(scene, 0) == 1.5);
    CHECK(index_of(scene, 1) == 1.7);
    auto const [low, high] = scene.bvh->bounds();
    CHECK(length(low) < 1e-15);
    CHECK(length(high - dvec3(0.07, 0.02, 0.01)) < 1e-15);
}

TEST_CASE("an experiment takes parts of an OBJ file, and its own glass goes before the file's") {
    TemporaryFolder const folder;
    Scene const tip = scene_with(folder, "length_unit = \"mm\"\nparts = [\"tip\"]");
    REQUIRE(tip.bodies.size() == 1);
    CHECK(index_of(tip, 0) == 1.7);
    CHECK(length(tip.bvh->bounds().first - dvec3(0.006, 0.0, 0.0)) < 1e-15);
    CHECK(scene_with(folder, "length_unit = \"mm\"\nparts = [\"sharp\"]").bodies.size() == 1); // its group
    CHECK(scene_with(folder, "length_unit = \"mm\"\nparts = [\"*\"]").bodies.size() == 2);
    CHECK(error_of([&] {
              scene_with(folder, "length_unit = \"mm\"\nparts = [\"blunt\"]");
          }).find("box, tip") != std::string::npos);
    Scene const mapped =
        scene_with(folder, "length_unit = \"mm\"\nmaterials = {flint = {medium = \"vacuum\"}}");
    CHECK(index_of(mapped, 0) == 1.5);
    CHECK(index_of(mapped, 1) < 1.0);
}

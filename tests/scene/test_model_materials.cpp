// What a model file's materials become: bodies, thin walls, mirrors and paint; and what the experiment maps
// them to.
#include "math/input_error.h"
#include "run/holes.h"
#include "scene/model_parts.h"
#include "scene/read_gltf.h"
#include "support/catch.h"
#include "support/gltf.h"
#include "support/lab.h"
#include "support/meshes.h"

#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

std::string const clear_glass =
    R"([{"name": "Glass", "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.5}}}])";

std::string const uses = R"(, "extensionsUsed": ["KHR_materials_transmission", "KHR_materials_ior",
    "KHR_materials_volume", "KHR_materials_specular", "KHR_materials_dispersion"])";

TriangleSoup square(double z) {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    soup.positions = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
    add_triangle(soup, 0, 1, 2);
    add_triangle(soup, 0, 2, 3);
    return soup;
}

TriangleSoup joined(TriangleSoup one, TriangleSoup const& other) {
    std::uint32_t const first = static_cast<std::uint32_t>(one.positions.size());
    one.positions.insert(one.positions.end(), other.positions.begin(), other.positions.end());
    for (auto const& [a, b, c] : other.triangles)
        add_triangle(one, first + a, first + b, first + c);
    return one;
}

/// An object "thing" of the model in an experiment with a ray down the z axis.
struct Thing {
    TemporaryFolder folder{"materials"};
    Lab lab;
    ObjectSpec object{"thing", ModelReference{}, {}, {}, {}, {}, 0, {}};

    explicit Thing(std::string const& text) {
        reference().path = folder.write("thing.gltf", text);
        lab.rays({{{0.1, 0.2, 5.0}, {0.0, 0.0, -1.0}}});
    }
    ModelReference& reference() { return std::get<ModelReference>(object.what); }
    Scene scene() {
        lab.experiment.objects = {object};
        return build_scene(lab.experiment);
    }
    Traced traced() { return trace(scene(), lab.experiment.trace); }
};

bool warns(Scene const& scene, std::string const& part) {
    for (std::string const& warning : scene.warnings)
        if (warning.find(part) != std::string::npos)
            return true;
    return false;
}

template <class Action>
std::string complaint(Action const& action) {
    try {
        action();
    } catch (InputError const& error) {
        return error.what();
    }
    return "";
}

double escaped(Traced const& traced, double sense) {
    double sum = 0.0;
    for (Segment const& segment : traced.segments())
        if (segment.ended == Event::escaped && segment.direction.z * sense > 0.0)
            sum += segment.power_end;
    return sum;
}

} // namespace

TEST_CASE("a closed mesh of glass without volume is a body, an open one a thin wall, and both are told",
          "[scene]") {
    Thing closed(gltf_text({box_soup(dvec3(-1.0), dvec3(1.0))}, clear_glass, "", uses));
    Scene const body = closed.scene();
    REQUIRE(body.bodies.size() == 1);
    CHECK_FALSE(body.bodies[0].open);
    CHECK(body.media[body.bodies[0].medium.value].name == "thing:Glass");
    CHECK_FALSE(body.faces[0].surface);
    CHECK(warns(body, "the mesh is closed, and is taken as a body"));

    Thing open(gltf_text({square(0.0)}, clear_glass, "", uses));
    Scene const wall = open.scene();
    REQUIRE(wall.bodies.size() == 1);
    CHECK(wall.bodies[0].open);
    CHECK(wall.shells.empty());
    REQUIRE(wall.faces[0].surface);
    CHECK(std::holds_alternative<ThinWall>(wall.surfaces[wall.faces[0].surface->value].kind));
    CHECK(warns(wall, "it is open and without volume, and material Glass is traced as a thin wall"));
    Traced const traced = open.traced();
    CHECK(std::abs(escaped(traced, 1.0) - 2.0 * 0.04 / 1.04) < 1e-15);
    CHECK(std::abs(escaped(traced, -1.0) - 0.96 / 1.04) < 1e-15);
}

TEST_CASE("glass of an MTL file is a thin wall where the mesh is open, and a body where it is closed",
          "[scene]") {
    Thing thing("");
    thing.folder.write("a.mtl", "newmtl Glass\nillum 7\nNi 1.5\n");
    std::string const corners = "mtllib a.mtl\nusemtl Glass\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv 0 0 1\n";
    thing.reference().path = thing.folder.write("wall.obj", corners + "f 1 2 3\n");
    Scene const wall = thing.scene();
    REQUIRE(wall.bodies.size() == 1);
    CHECK(wall.bodies[0].open);
    CHECK(std::holds_alternative<ThinWall>(wall.surfaces[wall.faces[0].surface->value].kind));
    CHECK(warns(wall, "it is open, and the glass Glass is traced as a thin wall"));
    thing.reference().path = thing.folder.write("body.obj", corners + "f 3 2 1\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    Scene const body = thing.scene();
    REQUIRE(body.bodies.size() == 1);
    CHECK_FALSE(body.bodies[0].open);
    CHECK(body.media[body.bodies[0].medium.value].name == "thing:Glass");
    CHECK(body.warnings.empty());
}

TEST_CASE("the picture of a glTF material's colour is kept, with its coordinates at each corner", "[scene]") {
    std::string text =
        gltf_text({square(0.0)}, R"([{"name": "Floor", "pbrMetallicRoughness": {
        "baseColorTexture": {"index": 0, "texCoord": 1}}}])",
                  "", R"(, "textures": [{"source": 1}], "images": [{"uri": "a.png"}, {"uri": "b.png"}])");
    auto const put = [&](std::string const& behind, std::string const& what) {
        std::size_t const at = text.find(behind);
        REQUIRE(at != std::string::npos);
        text.insert(at + behind.size(), what);
    };
    put(R"("POSITION": 0)", R"(, "TEXCOORD_1": 2)");
    put(R"("type": "SCALAR", "count": 6})", // the numbers of the positions, two by two
        R"(, {"bufferView": 0, "componentType": 5126, "type": "VEC2", "count": 4})");
    TemporaryFolder const folder("texture");
    folder.write("b.png", "");
    Model const model = read_gltf(folder.write("a.gltf", text));
    auto const& texture = model.materials.at(0).color_texture;
    REQUIRE(texture);
    CHECK(texture->file == std::filesystem::canonical(folder.path / "b.png"));
    CHECK(texture->problem.empty());
    CHECK(texture->coordinates == 1);
    auto const& corners = model.meshes.at(0).soup.texture_coordinates;
    REQUIRE(corners.size() == 2); // v runs downwards in glTF
    CHECK(corners[0] == std::array<vec2, 3>{vec2(-1.0, 2.0), vec2(0.0, 0.0), vec2(-1.0, 1.0)});
    CHECK(corners[1] == std::array<vec2, 3>{vec2(-1.0, 2.0), vec2(-1.0, 1.0), vec2(1.0, 0.0)});
    text.replace(text.find(R"("type": "VEC2", "count": 4)"), 26, R"("type": "VEC2", "count": 9)");
    Model const short_of_data = read_gltf(folder.write("a.gltf", text));
    CHECK(short_of_data.meshes.at(0).soup.texture_coordinates.empty());
    CHECK_FALSE(short_of_data.warnings.empty());
}

TEST_CASE("open and closed pieces of one mesh become a body and a surface", "[scene]") {
    Thing thing(gltf_text({joined(box_soup(dvec3(-1.0), dvec3(1.0)), square(3.0))}, clear_glass, "", uses));
    Scene const scene = thing.scene();
    REQUIRE(scene.bodies.size() == 2);
    CHECK(scene.bodies[0].open != scene.bodies[1].open);
    CHECK(scene.shells.size() == 1);
    Traced const traced = thing.traced();
    CHECK(traced.ended(Event::leak) == 0);
    CHECK(std::abs(traced.result.tally.remainder()) < 1e-13);
}

TEST_CASE("closed pieces of one mesh and two materials are bodies of their own media, the inner one within",
          "[scene]") {
    TriangleSoup const outer = box_soup(dvec3(-2.0), dvec3(2.0)), inner = box_soup(dvec3(-1.0), dvec3(1.0));
    std::string text =
        gltf_text({outer, inner},
                  R"([{"name": "A", "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.5}}},
        {"name": "B", "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 2}}}])",
                  R"([{"name": "both", "mesh": 0}])", uses);
    std::string const apart = R"(]}, {"name": "mesh1", "primitives": [)";
    std::size_t const at = text.find(apart);
    REQUIRE(at != std::string::npos);
    Thing thing(text.replace(at, apart.size(), ", ")); // one mesh of two primitives
    Scene const scene = thing.scene();
    REQUIRE(scene.bodies.size() == 2);
    CHECK(scene.media[scene.bodies[0].medium.value].name == "thing:A");
    CHECK(scene.media[scene.bodies[1].medium.value].name == "thing:B");
    Traced const traced = thing.traced(); // down the axis: air, A, B, A, air
    std::vector<std::string> media;
    for (std::int32_t at_segment = 0; at_segment >= 0;) {
        std::int32_t next = -1;
        media.push_back(scene.media[traced.segments()[static_cast<std::size_t>(at_segment)].medium].name);
        for (std::size_t i = 0; i < traced.segments().size() && next < 0; ++i)
            if (traced.segments()[i].parent == at_segment && traced.segments()[i].born == Event::refracted)
                next = static_cast<std::int32_t>(i);
        at_segment = next;
    }
    REQUIRE(media.size() == 5);
    CHECK(media[1] == "thing:A");
    CHECK(media[2] == "thing:B");
    CHECK(media[3] == "thing:A");
}

TEST_CASE("absorption of a volume is Beer and Lambert's law, in metres of the world whatever scales the node",
          "[scene]") {
    // T = colour^(x / distance) along the way through a block of 2 · scale metres
    std::string const material =
        R"([{"name": "Ink", "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.5},
        "KHR_materials_volume": {"thicknessFactor": 7, "attenuationDistance": 1.25, "attenuationColor": [0.1, 0.5, 0.9]}}}])";
    for (double scale : {0.25, 1.0, 2.0})
        for (auto const& [wavelength, colour] :
             {std::pair{450e-9, 0.9}, std::pair{550e-9, 0.5}, std::pair{650e-9, 0.1}}) {
            std::string const s = std::to_string(scale);
            Thing thing(gltf_text(
                {box_soup(dvec3(-1.0), dvec3(1.0))}, material,
                R"([{"name": "n", "mesh": 0, "scale": [)" + s + ", " + s + ", -" + s + "]}]", uses));
            thing.lab.experiment.sources[0].wavelengths = {{wavelength, 1.0}};
            Traced const traced = thing.traced();
            Segment const* inside = nullptr;
            for (Segment const& segment : traced.segments())
                if (segment.parent == 0 && segment.born == Event::refracted)
                    inside = &segment;
            REQUIRE(inside);
            CHECK(inside->length == Approx(2.0 * scale).epsilon(1e-14));
            CHECK(inside->power_end / inside->power_start ==
                  Approx(std::pow(colour, 2.0 * scale / 1.25)).epsilon(1e-13));
            CHECK(std::abs(traced.result.tally.remainder()) < 1e-14);
        }
}

TEST_CASE("base colour and transmission tint each surface of glass, and the warning names the share",
          "[scene]") {
    std::string const material =
        R"([{"name": "Blender", "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0,
        "baseColorFactor": [0.8, 0.8, 0.8, 1]}, "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_ior": {"ior": 1.5}, "KHR_materials_volume": {"thicknessFactor": 1}}}])";
    Thing thing(gltf_text({box_soup(dvec3(-1.0), dvec3(1.0))}, material, "", uses));
    thing.lab.experiment.trace.max_depth = 2;
    CHECK(warns(thing.scene(), "takes 20 % of the light that goes through each surface"));
    Traced const traced = thing.traced();
    CHECK(escaped(traced, -1.0) == Approx(0.96 * 0.8 * 0.96 * 0.8).epsilon(1e-13));
    CHECK(escaped(traced, 1.0) >= 0.04);
    CHECK(traced.watts(traced.result.tally.absorbed) > 0.3);
    CHECK(std::abs(traced.result.tally.remainder()) < 1e-14);
}

TEST_CASE("metal is a mirror of its base colour, ior 0 one of its specular colour, what is opaque absorbs",
          "[scene]") {
    std::string const materials =
        R"([{"name": "Metal", "pbrMetallicRoughness": {"roughnessFactor": 0, "baseColorFactor": [0.9, 0.6, 0.3, 1]}},
        {"name": "Ideal", "pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {"KHR_materials_ior": {"ior": 0},
            "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [0.8, 1, 1]}}},
        {"name": "Wall", "pbrMetallicRoughness": {"metallicFactor": 0}},
        {"name": "Veil", "alphaMode": "BLEND", "pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [1, 1, 1, 0.3]}}])";
    auto const reflected = [&](std::size_t which, double wavelength) {
        std::vector<TriangleSoup> const soups(4, square(0.0));
        Thing thing(gltf_text(soups, materials, "", uses));
        thing.reference().parts = {"part" + std::to_string(which)};
        thing.lab.experiment.sources[0].wavelengths = {{wavelength, 1.0}};
        Traced const traced = thing.traced();
        CHECK(std::abs(traced.result.tally.remainder()) < 1e-15);
        return std::pair(escaped(traced, 1.0), escaped(traced, -1.0));
    };
    CHECK(reflected(0, 650e-9) == std::pair(0.9, 0.0));
    CHECK(reflected(0, 450e-9) == std::pair(0.3, 0.0));
    CHECK(reflected(1, 650e-9) == std::pair(0.4, 0.0));
    CHECK(reflected(1, 550e-9) == std::pair(0.5, 0.0));
    CHECK(reflected(2, 550e-9) == std::pair(0.0, 0.0));
    auto const veil = reflected(3, 550e-9); // covers 0.3, the rest goes straight on
    CHECK(veil.first == 0.0);
    CHECK(veil.second == Approx(0.7).epsilon(1e-15));
    Thing thing(gltf_text({square(0.0), square(1.0), square(2.0), square(3.0)}, materials, "", uses));
    auto const& surfaces = thing.scene().surfaces;
    CHECK(std::any_of(surfaces.begin(), surfaces.end(), [](Surface const& surface) {
        auto const* const paint = std::get_if<Paint>(&surface.kind);
        return paint && paint->covers == 0.3; // in pictures it is seen, and does not only darken
    }));
}

TEST_CASE("a mapping gives a material a medium, a surface or both, before what the file says", "[scene]") {
    Thing thing(gltf_text({box_soup(dvec3(-1.0), dvec3(1.0))}, clear_glass, "", uses));
    MediumId const dense = thing.lab.medium(1.8);
    SurfaceId const half = thing.lab.surface(Shares{0.5, 0.5});
    thing.reference().materials = {{"Glass", dense, {}, {}}};
    Scene const medium = thing.scene();
    CHECK(medium.bodies[0].medium == dense);
    CHECK_FALSE(medium.faces[0].surface);
    CHECK(medium.warnings.empty());
    thing.reference().materials = {{"Glass", {}, half, {}}};
    CHECK(thing.scene().faces[0].surface == half);
    CHECK(thing.scene().bodies[0].medium == thing.lab.experiment.surroundings);
    thing.reference().materials = {{"Glass", dense, half, {}}};
    CHECK(thing.scene().faces[0].surface == half);
    CHECK(thing.scene().bodies[0].medium == dense);
    thing.reference().materials = {{"Glas", dense, half, {}}};
    CHECK(complaint([&] { thing.scene(); }).find("did you mean 'Glass'") != std::string::npos);
}

TEST_CASE("an experiment's own medium makes an open mesh a body with holes, and it is told", "[scene]") {
    Thing thing(gltf_text({square(0.0)}, clear_glass, "", uses));
    thing.object.medium = thing.lab.medium(1.5);
    Scene const scene = thing.scene();
    CHECK_FALSE(scene.bodies[0].open);
    std::vector<std::string> const told = unclosed_warnings(scene);
    REQUIRE(told.size() == 1);
    CHECK(told[0].find("4 border edges") != std::string::npos);
}

TEST_CASE("patterns of parts match names with any characters for a star and one for a question mark",
          "[scene]") {
    CHECK(matches("*", ""));
    CHECK(matches("*", "Lens.001"));
    CHECK(matches("Lens*", "Lens"));
    CHECK(matches("Lens*", "Lens.001"));
    CHECK_FALSE(matches("Lens*", "lens"));
    CHECK(matches("*.00?", "Lens.001"));
    CHECK_FALSE(matches("*.00?", "Lens.0012"));
    CHECK(matches("a*b*c", "a-b-b-c"));
    CHECK_FALSE(matches("a*b*c", "a-c-b"));
    CHECK_FALSE(matches("", "x"));
    CHECK(matches("", ""));
    CHECK(matches(std::string(2000, '*') + "b", std::string(2000, 'a') + "b")); // and in no time
}

TEST_CASE("parts name instances, or the nodes that hold them, and one that names nothing is an error",
          "[scene]") {
    Thing thing(gltf_text({box_soup(dvec3(-1.0), dvec3(1.0))}, clear_glass,
                          R"([{"name": "Bench", "children": [1, 2]}, {"name": "Lens.001", "mesh": 0},
                              {"name": "Lens.002", "mesh": 0, "translation": [0, 0, 9]}, {"name": "Cube", "mesh": 0, "translation": [9, 0, 0]}])",
                          uses));
    auto const names = [&](std::vector<std::string> parts) {
        thing.reference().parts = std::move(parts);
        std::vector<std::string> bodies;
        for (Body const& body : thing.scene().bodies)
            bodies.push_back(body.name);
        return bodies;
    };
    CHECK(names({}).size() == 3);
    CHECK(names({"*"}).size() == 3);
    CHECK(names({"Lens*"}) == std::vector<std::string>{"thing.Lens_001", "thing.Lens_002"});
    CHECK(names({"Bench"}) == std::vector<std::string>{"thing.Lens_001", "thing.Lens_002"});
    CHECK(names({"Cube", "Lens.001"}) == std::vector<std::string>{"thing.Lens_001", "thing.Cube"});
    CHECK(complaint([&] { names({"Lens*", "Cubes"}); }).find("nearest is 'Cube'") != std::string::npos);
}

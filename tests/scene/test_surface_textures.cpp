// Colours that surfaces take from pictures: of an experiment's paint, of models, within their files and
// beside them.
#include "image/image.h"
#include "math/input_error.h"
#include "scene/surface_textures.h"
#include "support/catch.h"
#include "support/gltf.h"
#include "support/lab.h"

#include <fstream>
#include <iterator>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr dvec3 red(1, 0, 0), green(0, 1, 0), blue(0, 0, 1), white(1.0);

/// Four pixels: red and green above, blue and white below.
Image quarters() {
    Image image{2, 2, 3, {}};
    for (dvec3 const& colour : {red, green, blue, white})
        for (int c = 0; c < 3; ++c)
            image.pixels.push_back(static_cast<float>(colour[c]));
    return image;
}

std::vector<unsigned char> bytes_of(std::filesystem::path const& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// What a ray along −z from above (x, y) meets.
dvec3 colour_at(Scene const& scene, SurfaceTextures const& textures, double x, double y) {
    Interface found;
    dvec3 const from(x, y, 10.0), down(0, 0, -1);
    Meeting const meeting = next_interface(scene, from, down, {}, {}, {}, found);
    REQUIRE(meeting == Meeting::interface);
    return textures.at(scene, found);
}

void check_quarters(Scene const& scene) {
    SurfaceTextures const textures(scene);
    CHECK(textures.warnings().empty());
    CHECK(colour_at(scene, textures, -0.5, 0.5) == red);
    CHECK(colour_at(scene, textures, 0.5, 0.5) == green);
    CHECK(colour_at(scene, textures, -0.5, -0.5) == blue);
    CHECK(colour_at(scene, textures, 0.5, -0.5) == white);
}

/// A square of 2 × 2 at z = 0 with coordinates on it, its material's picture as `image` says.
std::string textured_square(std::string const& image, std::string const& more = "",
                            std::string const& use = "") {
    TriangleSoup soup;
    soup.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}};
    std::string text = gltf_text({soup},
                                 R"([{"name": "Page", "pbrMetallicRoughness": {"metallicFactor": 0,
                                 "baseColorTexture": {"index": 0)" +
                                     use + "}}}]",
                                 "", R"(, "textures": [{"source": 0}], "images": [)" + image + "]" + more);
    // coordinates beside the positions: a buffer of their own, v downwards
    std::vector<unsigned char> bytes;
    for (float const number : {0.0F, 1.0F, 1.0F, 1.0F, 1.0F, 0.0F, 0.0F, 0.0F}) {
        unsigned char raw[4];
        std::memcpy(raw, &number, 4);
        bytes.insert(bytes.end(), raw, raw + 4);
    }
    auto const put = [&](std::string const& before, std::string const& what) {
        std::size_t const at = text.find(before);
        REQUIRE(at != std::string::npos);
        text.insert(at, what);
    };
    put(R"(], "bufferViews")",
        R"(, {"byteLength": 32, "uri": "data:application/octet-stream;base64,)" + base64(bytes) + R"("})");
    put(R"(], "accessors")", R"(, {"buffer": 1, "byteLength": 32})");
    std::size_t const at = text.find("]", text.find(R"("accessors": [)"));
    text.insert(at, R"(, {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"})");
    std::string const position = R"("POSITION": 0)";
    text.insert(text.find(position) + position.size(), R"(, "TEXCOORD_0": 2)");
    return text;
}

Scene scene_of(std::filesystem::path const& model) {
    Lab lab;
    ModelReference reference;
    reference.path = model;
    lab.experiment.objects.push_back({"page", reference, {}, {}, {}, {}, 0, {}});
    lab.rays({{{0, 0, 5}, {0, 0, -1}}});
    return build_scene(lab.experiment);
}

} // namespace

TEST_CASE("paint takes its colours from the picture that the experiment names", "[scene]") {
    TemporaryFolder const folder("paint_texture");
    write_image(folder.path / "q.png", quarters());
    Lab lab;
    Paint paint;
    paint.diffuse = {1, 1, 1};
    paint.texture = (folder.path / "q.png").string();
    lab.sheet("page", Rectangle{{2.0, 2.0}}, lab.surface(paint));
    lab.sheet("plain", Rectangle{{2.0, 2.0}}, lab.surface(Diffuse{0.5}), moved({5, 0, 0}));
    lab.rays({{{0, 0, 5}, {0, 0, -1}}});
    Scene const scene = build_scene(lab.experiment);
    check_quarters(scene);
    CHECK(colour_at(scene, SurfaceTextures(scene), 5.2, 0.3) == white);
    // a footprint of the whole square is the mean
    Interface found;
    dvec3 const from(0.2, 0.1, 10.0), down(0, 0, -1);
    next_interface(scene, from, down, {}, {}, {}, found);
    dvec3 const mean = SurfaceTextures(scene).at(scene, found, {4, 0, 0}, {0, 4, 0});
    CHECK(length(mean - dvec3(0.5)) < 1e-6);
    std::filesystem::remove(folder.path / "q.png");
    CHECK_THROWS_AS(SurfaceTextures(scene), InputError);
}

TEST_CASE("a model's picture is found beside it, in its buffer and in its text", "[scene]") {
    TemporaryFolder const folder("model_texture");
    write_image(folder.path / "my q.png", quarters());
    auto const bytes = bytes_of(folder.path / "my q.png");
    std::string const data = base64(bytes);
    check_quarters(scene_of(folder.write("beside.gltf", textured_square(R"({"uri": "my%20q.png"})"))));
    check_quarters(scene_of(folder.write(
        "in_text.gltf", textured_square(R"({"uri": "data:image/png;base64,)" + data + R"("})"))));
    std::string text = textured_square(R"({"bufferView": 3, "mimeType": "image/png"})");
    std::string const size = std::to_string(bytes.size());
    text.insert(text.find(R"(], "bufferViews")"), R"(, {"byteLength": )" + size +
                                                      R"(, "uri": "data:application/octet-stream;base64,)" +
                                                      data + R"("})");
    text.insert(text.find(R"(], "accessors")"), R"(, {"buffer": 2, "byteLength": )" + size + "}");
    check_quarters(scene_of(folder.write("in_buffer.gltf", text)));
}

TEST_CASE("KHR_texture_transform scales, turns and moves a model's picture, and its sampler mirrors it",
          "[scene]") {
    TemporaryFolder const folder("texture_transform");
    write_image(folder.path / "q.png", quarters());
    auto const at = [&](std::string const& transform, double x, double y, std::string const& more = "") {
        std::string text = textured_square(R"({"uri": "q.png"})", more,
                                           R"(, "extensions": {"KHR_texture_transform": )" + transform + "}");
        if (!more.empty())
            text.replace(text.find(R"({"source": 0})"), 13, R"({"source": 0, "sampler": 0})");
        Scene const scene = scene_of(folder.write("t.gltf", text));
        return colour_at(scene, SurfaceTextures(scene), x, y);
    };
    CHECK(at(R"({"offset": [0.5, 0]})", -0.5, 0.5) == green);
    CHECK(at(R"({"offset": [0, 0.5]})", -0.5, 0.5) == blue);
    CHECK(at(R"({"scale": [2, 1]})", 0.25, 0.5) == red); // the second repetition
    CHECK(at(R"({"scale": [2, 1]})", 0.25, 0.5, R"(, "samplers": [{"wrapS": 33648}])") == green);
    // a quarter turn about the picture's upper left corner: (u, v) goes to (v, −u)
    CHECK(at(R"({"rotation": 1.5707963267948966})", -0.5, 0.5) == blue); // the other way round: green
    CHECK(at(R"({"rotation": 1.5707963267948966})", -0.5, -0.5) == white);
    CHECK(at(R"({"rotation": "x", "scale": [1, null], "offset": 3})", -0.5, 0.5) == red);
}

TEST_CASE("a model's picture that cannot be read is white, with a warning that names it", "[scene]") {
    TemporaryFolder const folder("broken_texture");
    folder.write("bad.png", "no picture");
    for (char const* const image :
         {R"({"uri": "bad.png"})", R"({"uri": "none.png"})", R"({"uri": "../q.png"})",
          R"({"uri": "data:image/png;base64,AAAA"})", R"({"bufferView": 77})", R"({"bufferView": 0})",
          R"({})", R"({"uri": 3})", R"(7)"}) {
        INFO(image);
        Scene const scene = scene_of(folder.write("t.gltf", textured_square(image)));
        SurfaceTextures const textures(scene);
        CHECK(colour_at(scene, textures, 0.5, 0.5) == white);
        REQUIRE(textures.warnings().size() == 1);
        CHECK(textures.warnings()[0].find(folder.path.string()) != std::string::npos);
    }
}

TEST_CASE("OBJ's map_Kd colours the faces that use it, and no others", "[scene]") {
    TemporaryFolder const folder("obj_texture");
    write_image(folder.path / "q.png", quarters());
    folder.write("a.mtl", "newmtl page\nKd 1 1 1\nmap_Kd q.png\nnewmtl plain\nKd 1 1 1\n");
    std::string const square = "mtllib a.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 9 -1 0\nv 9 1 0\n"
                               "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl page\nf 1/1 2/2 3/3 4/4\n";
    check_quarters(scene_of(folder.write("a.obj", square)));
    Scene const both = scene_of(folder.write("b.obj", square + "usemtl plain\nf 2/1 5/2 6/3 3/4\n"));
    check_quarters(both);
    CHECK(colour_at(both, SurfaceTextures(both), 3.0, 0.5) == white);
}

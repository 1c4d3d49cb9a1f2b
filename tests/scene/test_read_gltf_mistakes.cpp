// What read_gltf says to files with one thing wrong, or one thing out of the ordinary.
#include "math/input_error.h"
#include "scene/read_gltf.h"
#include "support/catch.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

using namespace sahl;

namespace {

namespace fs = std::filesystem;

/// A folder that is gone when the test is.
struct Folder {
    fs::path path = fs::temp_directory_path() / ("sahl_gltf_" + std::to_string(::getpid()));

    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    Folder(Folder const&) = delete;
    Folder& operator=(Folder const&) = delete;

    fs::path write(std::string const& name, std::string const& text) const {
        std::ofstream(path / name, std::ios::binary) << text;
        return path / name;
    }
};

/// What read_gltf complains of, without the path; "" where it reads the file.
std::string complaint(Folder const& folder, std::string const& text) {
    fs::path const path = folder.write("model.gltf", text);
    try {
        read_gltf(path);
    } catch (InputError const& error) {
        std::string const what = error.what();
        return what.substr(path.string().size());
    }
    return "";
}

std::string replaced(std::string text, std::string const& old, std::string const& now) {
    std::size_t const at = text.find(old);
    REQUIRE(at != std::string::npos);
    return text.replace(at, old.size(), now);
}

/// One triangle, (0,0,0) (1,0,0) (0,1,0), its indices 0, 1, 2 as 16-bit numbers behind the 36 bytes of
/// positions.
std::string const triangle =
    R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_ior"], "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"name": "n", "mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0, "mode": 4}]}],
 "materials": [{"name": "glass", "extensions": {"KHR_materials_ior": {"ior": 1.5168}}}],
 "buffers": [{"byteLength": 44, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAA="}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
               {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]})";

} // namespace

TEST_CASE("a plain triangle is read as it is") {
    Folder const folder;
    Model const model = read_gltf(folder.write("model.gltf", triangle));
    REQUIRE(model.meshes.size() == 1);
    TriangleSoup const& soup = model.meshes[0].soup;
    CHECK(soup.positions == std::vector<dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(soup.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    CHECK(soup.normals.empty());
    CHECK(soup.face_names == std::vector<std::string>{"glass"});
    CHECK(model.instances[0].name == "n");
    CHECK(model.materials[0].ior == 1.5168);
}

TEST_CASE("an index of refraction out of its range is refused with the place and the way out") {
    Folder const folder;
    CHECK(complaint(folder, replaced(triangle, "1.5168", "0.7")) ==
          ": /materials/0/extensions/KHR_materials_ior/ior: 0.7 is below 1; give 1 or more, or 0 for an "
          "ideal mirror");
    CHECK(complaint(folder, replaced(triangle, "1.5168", "\"1.5\"")) ==
          ": /materials/0/extensions/KHR_materials_ior/ior: this must be a finite number; correct it, or "
          "export the "
          "file again");
    CHECK(complaint(folder, replaced(triangle, "1.5168", "0")).empty());
    CHECK(complaint(folder, replaced(triangle, "1.5168", "1")).empty());
}

TEST_CASE("a whole number in an extension keeps its value, however large") {
    Folder const folder;
    std::string const text = replaced(triangle, R"("KHR_materials_ior": {"ior": 1.5168})",
                                      R"("KHR_materials_volume": {"attenuationDistance": 10000000000})");
    Model const model = read_gltf(folder.write("model.gltf", text));
    REQUIRE(model.materials[0].volume);
    CHECK(model.materials[0].volume->attenuation_distance == 1e10);
    CHECK(model.materials[0].volume->thickness_factor == 0.0);
    CHECK(model.materials[0].ior == 1.5);
}

TEST_CASE("sizes, offsets and indices out of range are refused, whatever 64 bits hold") {
    Folder const folder;
    auto const refused = [&](std::string const& old, std::string const& now) {
        INFO(old << " -> " << now);
        CHECK_FALSE(complaint(folder, replaced(triangle, old, now)).empty());
    };
    refused(R"("count": 3, "type": "VEC3")", R"("count": 4, "type": "VEC3")");
    refused(R"("count": 3, "type": "VEC3")", R"("count": 6148914691236517206, "type": "VEC3")");
    refused(R"("count": 3, "type": "VEC3")", R"("count": -1, "type": "VEC3")");
    refused(R"("count": 3, "type": "VEC3")", R"("count": 3, "byteOffset": 9007199254740992, "type": "VEC3")");
    refused(R"("byteOffset": 36)", R"("byteOffset": 40)");
    refused(R"("byteOffset": 36)", R"("byteOffset": -36)");
    refused(R"("byteLength": 44)", R"("byteLength": 45)");
    refused(R"("byteLength": 44)", R"("byteLength": 4000000000)");
    refused(R"("buffer": 0, "byteLength": 36)", R"("buffer": 4294967296, "byteLength": 36)");
    refused(R"("buffer": 0, "byteLength": 36)", R"("buffer": 0, "byteLength": 36, "byteStride": 8)");
    refused(R"("componentType": 5126)", R"("componentType": 5124)");
    refused(R"("componentType": 5123)", R"("componentType": 5122)"); // signed indices
    refused(R"("POSITION": 0)", R"("POSITION": 7)");
    refused(R"("indices": 1)", R"("indices": 0)");
    refused(R"("material": 0)", R"("material": 1)");
    refused(R"("mode": 4)", R"("mode": 7)");
    refused("AAABAAIAAAA=", "AAABAAMAAAA="); // an index of 3
    refused("AACAPwAAAAA", "AADAfwAAAAA");   // a NaN
    refused("AACAPwAAAAA", "AACAfwAAAAA");   // an infinity
}

TEST_CASE("an accessor without data is zeros, and cannot ask for more than the budget") {
    Folder const folder;
    std::string const bare = replaced(triangle, R"({"bufferView": 0, "componentType": 5126, "count": 3)",
                                      R"({"componentType": 5126, "count": 3)");
    CHECK(complaint(folder, bare).empty());
    CHECK_FALSE(complaint(folder, replaced(bare, R"("count": 3)", R"("count": 4000000000)")).empty());
}

TEST_CASE("JSON that is too deep or has too many values is refused before it is parsed") {
    Folder const folder;
    CHECK_FALSE(complaint(folder, std::string(100'000, '[')).empty());
    std::string many = R"({"asset": {"version": "2.0"}, "extras": [0)";
    for (int i = 0; i < 1'000'000; ++i)
        many += ",0";
    CHECK(complaint(folder, many + "]}").find("more than a million values") != std::string::npos);
}

TEST_CASE("buffers come from the model's own folder alone") {
    Folder const folder;
    std::string const uri =
        triangle.substr(triangle.find("data:"), triangle.find("AAA=\"") + 4 - triangle.find("data:"));
    std::string const bytes = std::string(12, '\0') + std::string("\0\0\x80\x3f", 4) + std::string(12, '\0') +
                              std::string("\0\0\x80\x3f", 4) + std::string(6, '\0') +
                              std::string("\1\0\2\0\0\0", 6);
    fs::create_directories(folder.path / "inner");
    folder.write("secret.bin", bytes);
    folder.write("inner/a + b.bin", bytes + "more");
    auto const read = [&](std::string const& name) {
        fs::path const path = folder.write("inner/model.gltf", replaced(triangle, uri, name));
        try {
            return read_gltf(path).meshes[0].soup.positions.size();
        } catch (InputError const&) {
            return std::size_t{0};
        }
    };
    CHECK(read("a + b.bin") == 3);
    CHECK(read("a%20+%20b.bin") == 3);
    for (char const* name : {"../secret.bin", "%2e%2e/secret.bin", "./a + b.bin", "inner/../a + b.bin", "",
                             ".", "..", "/dev/zero", "file:a + b.bin", "http://a/b.bin", "missing.bin",
                             "a + b.bin/", "..%5csecret.bin", "%00", "data:text/html,a"}) {
        INFO(name);
        CHECK(read(name) == 0);
    }
    fs::create_symlink(folder.path / "secret.bin", folder.path / "inner" / "link.bin");
    CHECK(read("link.bin") == 0);
}

TEST_CASE("required extensions that are not there are refused by name") {
    Folder const folder;
    std::string const text =
        complaint(folder, replaced(triangle, R"("scene": 0)",
                                   R"("scene": 0, "extensionsRequired": ["KHR_draco_mesh_compression"])"));
    CHECK(text.find("KHR_draco_mesh_compression") != std::string::npos);
    CHECK(text.find("export without compression") != std::string::npos);
    Model const used =
        read_gltf(folder.write("model.gltf", replaced(triangle, R"(["KHR_materials_ior"])",
                                                      R"(["KHR_materials_ior", "EXT_unheard_of"])")));
    REQUIRE(used.warnings.size() == 1);
    CHECK(used.warnings[0].find("EXT_unheard_of") != std::string::npos);
}

TEST_CASE("nodes that are no tree are refused") {
    Folder const folder;
    std::string const one = R"({"name": "n", "mesh": 0})";
    for (char const* nodes : {R"({"children": [0]})", R"({"children": [1]}, {"children": [0]})",
                              R"({"children": [1, 2]}, {"children": [3]}, {"children": [3]}, {"mesh": 0})",
                              R"({"children": [1]})", R"({"children": [1, 1]}, {"mesh": 0})"}) {
        INFO(nodes);
        CHECK_FALSE(complaint(folder, replaced(triangle, one, nodes)).empty());
    }
}

TEST_CASE("transforms compose from the root down: scale, then turn, then move") {
    Folder const folder;
    std::string const one = R"({"name": "n", "mesh": 0})";
    auto const place = [&](std::string const& nodes, dvec3 const& p) {
        Model const model = read_gltf(folder.write("model.gltf", replaced(triangle, one, nodes)));
        REQUIRE(model.instances.size() == 1);
        return model.instances[0].to_world.point(p);
    };
    // a quarter turn about z takes x to y
    dvec3 const turned = place(R"({"children": [1], "translation": [10, 0, 0]},
        {"mesh": 0, "translation": [0, 1, 0], "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476], "scale": [2, 3, 4]})",
                               dvec3(1.0, 1.0, 1.0));
    CHECK(length(turned - dvec3(7.0, 3.0, 4.0)) < 1e-14);
    CHECK(place(R"({"mesh": 0, "matrix": [-1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 5, 6, 7, 1]})", dvec3(1.0)) ==
          dvec3(4.0, 8.0, 10.0));
    CHECK_FALSE(
        complaint(folder, replaced(triangle, one, R"({"mesh": 0, "rotation": [0, 0, 1, 1]})")).empty());
    CHECK_FALSE(complaint(folder, replaced(triangle, one, R"({"mesh": 0, "matrix": [1, 2]})")).empty());
    CHECK_FALSE(complaint(folder, replaced(triangle, one,
                                           R"({"mesh": 0, "matrix": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]})"))
                    .empty());
    Model const flat =
        read_gltf(folder.write("model.gltf", replaced(triangle, one, R"({"mesh": 0, "scale": [1, 1, 0]})")));
    CHECK(flat.instances.empty());
    CHECK_FALSE(flat.warnings.empty());
}

TEST_CASE("one mesh may stand in several places, and without scenes every root does") {
    Folder const folder;
    std::string text =
        replaced(triangle, R"({"name": "n", "mesh": 0})", R"({"mesh": 0}, {"mesh": 0, "scale": [1, 1, -1]})");
    text = replaced(text, R"("scene": 0, "scenes": [{"nodes": [0]}],)", "");
    Model const model = read_gltf(folder.write("model.gltf", text));
    REQUIRE(model.instances.size() == 2);
    CHECK(model.instances[0].name == "node_0");
    CHECK(model.instances[1].mesh == 0);
    CHECK(glm::determinant(model.instances[1].to_world.linear) == -1.0);
}

TEST_CASE("strips, fans and lists without indices make the triangles of the specification") {
    Folder const folder;
    // zero indices of a fan over the same three corners: (1, 2, 0)
    Model const fan =
        read_gltf(folder.write("model.gltf", replaced(triangle, R"("mode": 4)", R"("mode": 6)")));
    CHECK(fan.meshes[0].soup.triangles == std::vector<std::array<std::uint32_t, 3>>{{1, 2, 0}});
    Model const strip =
        read_gltf(folder.write("model.gltf", replaced(triangle, R"("mode": 4)", R"("mode": 5)")));
    CHECK(strip.meshes[0].soup.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    Model const list = read_gltf(folder.write("model.gltf", replaced(triangle, R"("indices": 1, )", "")));
    CHECK(list.meshes[0].soup.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    Model const lines =
        read_gltf(folder.write("model.gltf", replaced(triangle, R"("mode": 4)", R"("mode": 1)")));
    CHECK(lines.meshes[0].soup.triangles.empty());
    CHECK(lines.warnings.size() == 1);
}

TEST_CASE("a .glb whose header lies is refused") {
    Folder const folder;
    std::ifstream stream(fs::path(SAHL_SOURCE_DIR) / "models" / "ball-320.glb", std::ios::binary);
    std::string const whole((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    REQUIRE(complaint(folder, whole).empty());
    for (std::size_t const size :
         {std::size_t{4}, std::size_t{12}, std::size_t{19}, std::size_t{100}, whole.size() - 1})
        CHECK_FALSE(complaint(folder, whole.substr(0, size)).empty());
    for (std::size_t const at : {4, 11, 15, 16}) { // version, length, length and type of the first chunk
        std::string lie = whole;
        lie[at] = '\x7f';
        CHECK_FALSE(complaint(folder, lie).empty());
    }
    std::string cut = whole; // a BIN chunk said to be longer than the file
    std::size_t const bin = whole.find("BIN", 20) - 4;
    cut[bin + 3] = '\x7f';
    CHECK_FALSE(complaint(folder, cut).empty());
}

TEST_CASE("what is no file at all is refused") {
    Folder const folder;
    CHECK_THROWS_AS(read_gltf(folder.path), InputError);
    CHECK_THROWS_AS(read_gltf(folder.path / "missing.glb"), InputError);
    CHECK_FALSE(complaint(folder, "").empty());
    CHECK_FALSE(complaint(folder, "{").empty());
    CHECK_FALSE(complaint(folder, "[1]").empty());
    CHECK_FALSE(complaint(folder, R"({"asset": {"version": "1.0"}})").empty());
}

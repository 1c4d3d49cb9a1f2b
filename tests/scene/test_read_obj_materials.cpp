// What MTL files make of an OBJ model: glass, mirrors and paint, and what is said of files that are missing,
// broken or elsewhere.
#include "math/input_error.h"
#include "scene/read_obj.h"
#include "scene/read_text.h"
#include "support/catch.h"

#include <algorithm>

using namespace sahl;

namespace {

namespace fs = std::filesystem;

std::string const triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";

/// The model of one triangle whose material `m` has these lines.
Model with_material(std::string const& lines) {
    TemporaryFolder const folder;
    folder.write("my floor.png", "");
    folder.write("a.png", "");
    folder.write("a.mtl", "newmtl m\n" + lines + "\nnewmtl unused\nNi abc\nillum 77\n");
    folder.write("a.obj", "mtllib a.mtl\n" + triangle);
    return read_obj(folder.path / "a.obj");
}

std::string kind(std::string const& lines) {
    ModelMaterial const material = with_material(lines).materials.at(0);
    return material.metallic >= 0.5 ? "mirror" : material.transmission > 0.0 ? "glass" : "paint";
}

bool warns(Model const& model, std::string const& of) {
    return std::any_of(model.warnings.begin(), model.warnings.end(),
                       [&](std::string const& warning) { return warning.find(of) != std::string::npos; });
}

/// What is refused, from the file's name on.
std::string complaint(std::string const& lines) {
    std::string const error = error_of([&] { with_material(lines); });
    std::size_t const at = error.find("a.mtl:");
    REQUIRE((error.empty() || at != std::string::npos));
    return error.empty() ? error : error.substr(at);
}

} // namespace

TEST_CASE("an MTL material is glass, mirror or paint by its illumination model") {
    for (int const illum : {4, 6, 7, 9})
        CHECK(kind("illum " + std::to_string(illum)) == "glass");
    for (int const illum : {3, 5, 8})
        CHECK(kind("illum " + std::to_string(illum)) == "mirror");
    for (int const illum : {0, 1, 2, 10})
        CHECK(kind("illum " + std::to_string(illum)) == "paint");
    CHECK(kind("") == "paint");
    CHECK(kind("Ni 1.5") == "paint");
    CHECK(kind("d 1\nTr 0") == "paint");
    CHECK(kind("d 0.1") == "glass");
    CHECK(kind("d -halo 0.1") == "glass");
    CHECK(kind("Tr 0.5\nillum 2") == "glass");
    CHECK(kind("Tf 1 1 1") == "glass");
    CHECK(kind("Tf 1 1 1\nillum 2") == "paint"); // there the model has no term for it
    CHECK(kind("d 0.5\nillum 3") == "mirror");
    CHECK(kind("Pm 1\nillum 2") == "mirror");
}

TEST_CASE("glass of an MTL file has the index Ni and the colour Tf, and is a body where it is closed") {
    Model const model = with_material("Kd 0.1 0.2 0.3\nNi 1.5168\nd 0.1\nTf 0.9 0.95 1\nillum 7");
    ModelMaterial const& glass = model.materials.at(0);
    CHECK(glass.ior == 1.5168);
    CHECK(glass.transmission == 1.0);
    CHECK(glass.metallic == 0.0);
    CHECK(glass.roughness == 0.0);
    CHECK(glass.base_color == std::array<double, 4>{0.9, 0.95, 1.0, 1.0});
    CHECK(glass.may_be_body);
    CHECK_FALSE(glass.volume); // open, it is a thin wall
    CHECK(model.warnings.empty());
}

TEST_CASE("glass without Ni has 1.5, with a word, and an Ni of 1 is kept, with another") {
    Model const absent = with_material("illum 7");
    CHECK(absent.materials[0].ior == 1.5);
    CHECK(warns(absent, "1.5 is assumed"));
    Model const one = with_material("illum 7\nNi 1.0");
    CHECK(one.materials[0].ior == 1.0);
    CHECK(warns(one, "Ni 1 bends no light"));
}

TEST_CASE("a mirror reflects Ks, all where there is none, and a metal Kd") {
    CHECK(with_material("Kd 0 0 0\nillum 3").materials[0].base_color ==
          std::array<double, 4>{1.0, 1.0, 1.0, 1.0});
    Model const dim = with_material("Ks 0.5\nillum 3");
    CHECK(dim.materials[0].base_color == std::array<double, 4>{0.5, 0.5, 0.5, 1.0});
    CHECK(warns(dim, "this mirror reflects 50 %"));
    CHECK(with_material("Kd 0.9 0.8 0.7\nKs 0\nPm 1").materials[0].base_color ==
          std::array<double, 4>{0.9, 0.8, 0.7, 1.0});
}

TEST_CASE("numbers of MTL files that would change the light are refused with file and line") {
    CHECK(complaint("illum 7\nNi abc") == "a.mtl:3: Ni 'abc' cannot be read; give a finite number");
    CHECK(complaint("illum 7\nNi 0.7") ==
          "a.mtl:3: Ni 0.7 is below 1; give the index of refraction, 1.5 for plain glass");
    for (char const* lines : {"Ni nan\nillum 6",
                              "Ni\nd 0.5",
                              "Ni -1.5\nillum 9",
                              "Ni 1e9\nillum 4",
                              "Ni 1,5\nTr 1",
                              "illum seven",
                              "illum 11",
                              "illum 2.5",
                              "illum -1",
                              "d 2",
                              "d x",
                              "Tr -1",
                              "d",
                              "Ks abc\nillum 3",
                              "Ks 1 2\nillum 3",
                              "Ks -1\nillum 5",
                              "Kd inf\nPm 1",
                              "Pm 2",
                              "Tf 1 1\nillum 7",
                              "Tf -1\nd 0"}) {
        INFO(lines);
        CHECK_FALSE(complaint(lines).empty());
    }
}

TEST_CASE("numbers of MTL files that change nothing are warned of") {
    for (char const* lines : {"Ni abc", "Ni 1.2.3\nillum 2", "Kd x", "Ks y\nillum 7\nNi 1.5", "Pr 7"}) {
        INFO(lines);
        CHECK(warns(with_material(lines), "it is left out"));
    }
    CHECK(with_material("Ni 0.7").warnings.empty());
}

TEST_CASE("what else MTL files say is named") {
    CHECK(warns(with_material("d 0.4\nTr 0.1"), "contradict each other"));
    CHECK(warns(with_material("d 0.9\nNi 1.5"), "more opaque than not"));
    CHECK(warns(with_material("map_Kd floor.png"), "texture map_Kd shows in pictures alone"));
    CHECK(warns(with_material("norm bumps.png"), "surfaces are as smooth as the mesh"));
    CHECK(warns(with_material("Pr 0.5"), "roughness"));
    CHECK(warns(with_material("cauchy_B 0.0042"), "a.mtl:2: 'cauchy_B' is no key of MTL"));
    CHECK(warns(with_material("newmtl m"), "a second material 'm'"));
    CHECK(warns(with_material("Kd spectral ident.rfl"), "Kd as spectral is not read"));
    CHECK(warns(with_material("Ni 1.45\nillum 2\nd 1"), "'m': opaque by illum and d")); // Blender's glass
    CHECK_FALSE(warns(with_material("Ni 1\nillum 2"), "opaque by illum"));
    CHECK(with_material("map_Kd a.png\nmap_Kd b.png\nKd x\nKd y").warnings.size() == 2); // once each
    CHECK(with_material("Ka 1 1 1\nKs 1 1 1\nKe 0 0 0\nNs 96\nsharpness 60").warnings.empty());
}

TEST_CASE("the picture of a colour is kept by its path, whatever options stand before it") {
    for (char const* line : {"map_Kd my floor.png", "map_Kd -clamp on my floor.png",
                             "map_Kd -s 2 2 -o 0.5 0 0 -mm 0 1 my floor.png"}) {
        INFO(line);
        auto const texture = with_material(line).materials.at(0).color_texture;
        REQUIRE(texture);
        CHECK(texture->file.filename() == "my floor.png");
        CHECK(texture->problem.empty());
    }
    CHECK(with_material("map_Kd -clamp on a.png").materials.at(0).color_texture->across == Wrap::clamp);
    CHECK(with_material("map_Kd none.png").materials.at(0).color_texture->problem ==
          "the picture 'none.png' is not there");
    CHECK(with_material("map_Kd ../a.png").materials.at(0).color_texture->problem ==
          "the picture '../a.png' is no path to a file in the model's folder, and is not opened");
    for (char const* line : {"map_Kd", "map_Kd -s", "map_Kd -", "map_Ks a.png", "Kd 1 1 1"})
        CHECK_FALSE(with_material(line).materials.at(0).color_texture);
}

TEST_CASE("texture coordinates stay with the corners, and part no vertices") {
    TemporaryFolder const folder;
    auto const read = [&](std::string const& text) {
        folder.write("a.obj", text);
        return read_obj(folder.path / "a.obj");
    };
    folder.write("a.mtl", "newmtl m\nmap_Kd -s 2 3 -o 0.5 0.25 a.png\nnewmtl plain\nKd 1 0 0\n");
    std::string const corners = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                "vt 0.25 0.5\nvt 1 0\nvt 0 1\nvt 7\n";
    Model const model =
        read(corners + "usemtl m\nf 1/1 2/2 3/3\nf 1/-1 3/9 4\nusemtl plain\nf 1/1 2/2 3/3\n");
    ModelMesh const& mesh = model.meshes.at(0);
    CHECK(mesh.soup.positions.size() == 4);
    auto const& kept = mesh.soup.texture_coordinates;
    REQUIRE(kept.size() == 3);
    CHECK(kept[0] == std::array<vec2, 3>{vec2(1.0, 1.75), vec2(2.5, 0.25), vec2(0.5, 3.25)});
    CHECK(kept[1] == std::array<vec2, 3>{vec2(14.5, 0.25), vec2(0.5, 0.25), vec2(0.5, 0.25)});
    CHECK(kept[2] == std::array<vec2, 3>{});
    CHECK(read(corners + "usemtl plain\nf 1/1 2/2 3/3\n").meshes[0].soup.texture_coordinates.empty());
    CHECK(read(corners + "usemtl m\nf 1 2 3\n").meshes[0].soup.texture_coordinates.empty());
}

TEST_CASE("a missing or empty MTL file leaves opaque materials, with a word of the file and of the name") {
    TemporaryFolder const folder;
    folder.write("a.obj", "mtllib none.mtl\n" + triangle);
    Model const missing = read_obj(folder.path / "a.obj");
    CHECK(warns(missing, "a.obj:1: the MTL file 'none.mtl' is not there"));
    CHECK(warns(missing, "a.obj:5: no MTL file has 'm': taken as opaque"));
    REQUIRE(missing.materials.size() == 1);
    CHECK(missing.materials[0].name == "m");
    CHECK(missing.materials[0].metallic == 0.0);
    CHECK(missing.materials[0].transmission == 0.0);
    folder.write("none.mtl", "Kd 1 1 1\n");
    CHECK(warns(read_obj(folder.path / "a.obj"), "'Kd' stands before the first newmtl"));
    folder.write("none.mtl", "newmtl mm\n");
    CHECK(warns(read_obj(folder.path / "a.obj"), "(the nearest is 'mm')"));
    fs::create_directories(folder.path / "folder.mtl");
    folder.write("a.obj", "mtllib folder.mtl\n" + triangle);
    CHECK(warns(read_obj(folder.path / "a.obj"), "is not a file"));
    folder.write("a.obj", triangle); // no mtllib at all
    CHECK(warns(read_obj(folder.path / "a.obj"), "no MTL file has 'm'"));
    folder.write("a.obj", "usemtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK(read_obj(folder.path / "a.obj").meshes[0].face_material[0] == std::nullopt);
}

TEST_CASE("MTL files are found by one name or several, in the model's folder and nowhere else") {
    TemporaryFolder const folder;
    std::string const glass = "newmtl m\nillum 7\nNi 1.7\n";
    folder.write("secret.mtl", glass);
    for (char const* inside : {"b.mtl", "sub/b.mtl", "my glass.mtl"})
        folder.write(fs::path("inner") / inside, glass);
    fs::create_symlink(folder.path / "secret.mtl", folder.path / "inner" / "link.mtl");
    auto const index = [&](std::string const& names) {
        folder.write("inner/a.obj", "mtllib " + names + "\n" + triangle);
        Model const model = read_obj(folder.path / "inner" / "a.obj");
        CHECK(model.warnings.empty() == (model.materials[0].ior == 1.7));
        return model.materials[0].ior;
    };
    for (std::string const names : {"b.mtl", "./b.mtl", "sub/b.mtl", "sub\\b.mtl", "my glass.mtl"}) {
        INFO(names);
        CHECK(index(names) == 1.7);
    }
    std::string const absolute = (folder.path / "secret.mtl").string();
    for (std::string const& names :
         {std::string("../secret.mtl"), absolute, std::string("sub/../../secret.mtl"),
          std::string("link.mtl"), std::string("/dev/zero"), std::string("."), std::string(""),
          std::string("C:\\b.mtl"), "b.mtl" + std::string(1, '\0'), std::string(5000, 'x'),
          std::string("missing.mtl")}) {
        INFO(names);
        CHECK(index(names) == 1.5);
    }
    folder.write("inner/a.obj", "mtllib missing.mtl b.mtl\nmtllib missing.mtl b.mtl\n" + triangle);
    Model const model = read_obj(folder.path / "inner" / "a.obj");
    CHECK(model.materials[0].ior == 1.7);
    CHECK(warns(model, "'missing.mtl' is not there"));
    CHECK(model.warnings.size() == 1);
}

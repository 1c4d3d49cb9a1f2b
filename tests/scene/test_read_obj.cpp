// What read_obj makes of small files, line by line, and what it says to those with one thing wrong.
#include "math/input_error.h"
#include "scene/read_obj.h"
#include "scene/read_text.h"
#include "support/catch.h"

using namespace sahl;

namespace {

using Corners = std::array<std::uint32_t, 3>;

Model read(std::string const& text) {
    TemporaryFolder const folder;
    folder.write("model.obj", text);
    return read_obj(folder.path / "model.obj");
}

/// What read_obj complains of, from the line's number on; "" where it reads the file.
std::string complaint(std::string const& text) {
    TemporaryFolder const folder;
    folder.write("model.obj", text);
    std::string const path = (folder.path / "model.obj").string();
    std::string const error = error_of([&] { read_obj(path); });
    REQUIRE((error.empty() || error.rfind(path + ":", 0) == 0));
    return error.empty() ? error : error.substr(path.size() + 1);
}

bool starts(std::string const& text, std::string const& start) {
    return text.rfind(start, 0) == 0;
}

std::string const corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

} // namespace

TEST_CASE("a plain OBJ triangle is read as it is, whatever ends its lines") {
    for (std::string const end : {"\n", "\r\n", "\r"}) {
        Model const model = read("\xEF\xBB\xBF# a comment" + end + "v +.5 -1e-3 0 # a vertex" + end +
                                 " v\t1 0 0 0.3" + end + end + "v 0 \\" + end + " 0.1 0" + end + "f 1 2 3");
        REQUIRE(model.meshes.size() == 1);
        TriangleSoup const& soup = model.meshes[0].soup;
        CHECK(soup.positions == std::vector<dvec3>{{0.5, -1e-3, 0}, {1, 0, 0}, {0, 0.1, 0}});
        CHECK(soup.triangles == std::vector<Corners>{{0, 1, 2}});
        CHECK(soup.normals.empty());
        CHECK(soup.face_names == std::vector<std::string>{"surface"});
        CHECK(model.instances[0].name == "model");
        CHECK(model.instances[0].to_world == Affine());
        CHECK(model.meshes[0].face_material[0] == std::nullopt);
        CHECK(model.warnings.empty());
    }
}

TEST_CASE("negative OBJ indices count back from the last vertex so far, others may run ahead") {
    Model const model = read(corners + "f -3 -2 -1\nf 1 2 4\nv 0 0 1\nf -1 1 3\n");
    TriangleSoup const& soup = model.meshes[0].soup;
    CHECK(soup.triangles == std::vector<Corners>{{0, 1, 2}, {0, 1, 3}, {3, 0, 2}});
    CHECK(soup.positions[3] == dvec3(0, 0, 1));
}

TEST_CASE("normals of OBJ corners are made unit, and those without take their triangle's") {
    Model const model = read(corners + "v 0 0 1\nvt 0 0\nvn 0 0 2\nvn 3e200 0 4e200\nvn 0 0 0\n"
                                       "f 1//1 2/1/2 3//1\nf 1/1 3/1 4\nf 1//3 4//3 2//3\n");
    TriangleSoup const& soup = model.meshes[0].soup;
    REQUIRE(soup.normals.size() == soup.positions.size());
    auto const normal = [&](std::size_t t, std::size_t c) { return soup.normals[soup.triangles[t][c]]; };
    CHECK(normal(0, 0) == dvec3(0, 0, 1));
    CHECK(length(normal(0, 1) - dvec3(0.6, 0, 0.8)) < 1e-15);
    CHECK(soup.triangles[0][0] != soup.triangles[1][0]); // one position, two normals
    CHECK(normal(1, 0) == dvec3(1, 0, 0));
    CHECK(normal(1, 2) == dvec3(1, 0, 0));
    CHECK(normal(2, 1) == dvec3(0, 1, 0));
    REQUIRE(model.warnings.size() == 1);
    CHECK(model.warnings[0].find("3 vertices have a normal (vn) of no length") != std::string::npos);
}

TEST_CASE("OBJ objects are meshes, and their groups and materials are faces") {
    Model const model = read("o one\n" + corners + "g front\nf 1 2 3\ng back\nusemtl red\nf 3 2 1\no two\n" +
                             corners + "f 4 5 6\nusemtl blue.1\nf 6 5 4\no one\nf 1 3 2\n");
    REQUIRE(model.instances.size() == 2);
    CHECK(model.instances[0].name == "one");
    CHECK(model.instances[1].name == "two");
    CHECK(model.meshes[0].soup.triangles.size() == 3);
    // the group and the material stay until another is named
    CHECK(model.meshes[0].soup.face_names == std::vector<std::string>{"front", "back_red", "back_blue_1"});
    CHECK(model.meshes[0].face_material[0] == std::nullopt);
    CHECK(model.meshes[0].face_material[1] == 0u);
    CHECK(model.meshes[1].soup.face_names == std::vector<std::string>{"red", "blue_1"});
    CHECK(model.meshes[1].face_material[1] == 1u);
    CHECK(model.materials[1].name == "blue.1");
}

TEST_CASE("OBJ groups are meshes where there are no objects, unless they share vertices") {
    std::string const six = corners + corners;
    Model const apart = read(six + "g a b\nf 1 2 3\ng c\nf 4 5 6\n");
    REQUIRE(apart.instances.size() == 2);
    CHECK(apart.instances[0].name == "a b");
    CHECK(apart.meshes[1].soup.positions.size() == 3);
    Model const together = read(six + "g a\nf 1 2 3\ng c\nf 1 5 6\n");
    REQUIRE(together.instances.size() == 1);
    CHECK(together.instances[0].name == "model");
    CHECK(together.meshes[0].soup.face_names == std::vector<std::string>{"a", "c"});
}

TEST_CASE("numbers of OBJ files that are none are refused with their line") {
    CHECK(complaint("v 0 0 abc\n" + corners + "f 1 2 3") ==
          "1: 'abc' is not a finite number; correct it, or export the file again");
    for (char const* bad :
         {"v 0 0", "v", "v nan 0 0", "v 0 inf 0", "v 1e999 0 0", "v 0x1 0 0", "v 1,5 0 0", "v 1d3 0 0",
          "v 1e16 0 0", "v 3E4570711268 0 0", "vn 0 0 nan", "vn 1 2", "v --1 0 0", "v +-1 0 0"}) {
        INFO(bad);
        CHECK(starts(complaint(corners + bad + "\nf 1 2 3\n"), "4: "));
    }
    CHECK(starts(complaint("v 0 0 0" + std::string(1, '\0') + "\n"), "1: "));
    CHECK(read("v 1e-400 0 0\n" + corners + "f 1 3 4\n").meshes[0].soup.positions[0] == dvec3(0.0));
}

TEST_CASE("OBJ indices out of range are refused with their line") {
    for (char const* bad :
         {"0", "4", "-4", "4294967296", "4294967295", "99999999999999999999", "-9223372036854775808",
          "9223372036854775807", "1.5", "a", "1/a", "1//1", "1//-1", "1/1/1/1"}) {
        INFO(bad);
        CHECK(starts(complaint(corners + "f 1 2 3\nf 1 2 " + bad + "\nf 3 2 1\n"), "5: "));
    }
    CHECK(complaint(corners + "f 1/ 2// 3/7/\n").empty()); // nothing is missing that is read
    CHECK(complaint(corners + "f 1 2 4\n") ==
          "4: vertex 4 is not there: the file has 3; export the file again");
}

TEST_CASE("a file without a face is refused") {
    CHECK_FALSE(complaint("").empty());
    CHECK_FALSE(complaint(corners).empty());
    CHECK_FALSE(complaint(corners + "f 1 2\nl 1 2\np 1\n").empty());
    CHECK_FALSE(complaint(std::string(1000, '\0')).empty());
    CHECK_FALSE(complaint("\x89PNG\r\n\x1a\n").empty());
    std::string noise;
    for (int i = 0; i < 2000; ++i)
        noise += "x" + std::to_string(i) + " 1\n";
    CHECK(starts(complaint(noise), "1001: "));
    TemporaryFolder const folder;
    CHECK_FALSE(error_of([&] { read_obj(folder.path); }).empty());
    CHECK_FALSE(error_of([&] { read_obj(folder.path / "missing.obj"); }).empty());
}

TEST_CASE("what is left out of an OBJ file is said once, with the first line") {
    Model const model =
        read(corners + "vt 9 9\ns off\nf 1 2 3\nl 1 2\nl 2 3\nf 1 2\nsurf 0 1 0 1\ncsh rm\nhello\n");
    REQUIRE(model.warnings.size() == 5);
    CHECK(model.warnings[0].find("model.obj:9: 1 faces of fewer than three corners") != std::string::npos);
    CHECK(model.warnings[1].find("model.obj:7: 2 × 'l'") != std::string::npos);
    CHECK(model.warnings[2].find("'surf' is left out: only polygons are read") != std::string::npos);
    CHECK(model.warnings[3].find("'csh' is left out") != std::string::npos);
    CHECK(model.warnings[4].find("model.obj:12: 1 × 'hello' is no statement of OBJ") != std::string::npos);
}

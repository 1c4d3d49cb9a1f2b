// OBJ files made elsewhere, sound and malformed; and the library tinyobjloader, as a second opinion.
#include "geometry/mesh.h"
#include "math/input_error.h"
#include "scene/read_obj.h"
#include "scene/read_text.h"
#include "support/catch.h"

#include <tiny_obj_loader.h>

#include <cmath>
#include <random>
#include <sstream>

using namespace sahl;

namespace {

namespace fs = std::filesystem;

fs::path const shared = SAHL_SHARED_DATA;

/// Corner by corner what tinyobjloader reads, which rounds decimal numbers to a few ulp.
void check_against_tinyobjloader(fs::path const& path) {
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warning, error;
    REQUIRE(tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, path.string().c_str(),
                             (path.parent_path() / "").string().c_str()));
    Model const model = read_obj(path);
    REQUIRE(model.meshes.size() == shapes.size());
    for (std::size_t m = 0; m < shapes.size(); ++m) {
        TriangleSoup const& soup = model.meshes[m].soup;
        auto const& theirs = shapes[m].mesh;
        REQUIRE(soup.triangles.size() * 3 == theirs.indices.size());
        double farthest = 0.0;
        for (std::size_t i = 0; i < theirs.indices.size(); ++i) {
            auto const v = static_cast<std::size_t>(theirs.indices[i].vertex_index);
            dvec3 const p(attributes.vertices[3 * v], attributes.vertices[3 * v + 1],
                          attributes.vertices[3 * v + 2]);
            farthest = std::max(farthest,
                                length(soup.positions[soup.triangles[i / 3][i % 3]] - p) / (1.0 + length(p)));
        }
        CHECK(farthest < 1e-15 * 4.0);
    }
}

} // namespace

TEST_CASE("every malformed OBJ file is read or refused with file and place, and every valid one is read") {
    if (!fs::exists(shared / "badinput")) {
        WARN("skipped: no shared data");
        return;
    }
    int files = 0;
    for (fs::directory_entry const& entry : fs::recursive_directory_iterator(shared / "badinput")) {
        fs::path const& path = entry.path();
        std::string const name = path.filename().string();
        if (path.extension() != ".obj" && name.rfind("clusterfuzz", 0) != 0)
            continue;
        ++files;
        INFO(path.string());
        std::string const error = error_of([&] {
            for (ModelMesh const& mesh : read_obj(path).meshes)
                make_mesh(mesh.soup);
        });
        if (name.rfind("clusterfuzz", 0) == 0)
            CHECK(error == path.string() +
                               ":1: '3E4570711268?' is not a finite number; correct it, or export "
                               "the file again");
        else
            CHECK(error.empty());
    }
    CHECK(files > 0);
}

TEST_CASE("a box of quadrilaterals that has fooled a triangulation is closed, one by four by one") {
    fs::path const path = shared / "badinput" / "tinyobj" / "issue-295-trianguation-failure.obj";
    if (!fs::exists(path)) {
        WARN("skipped: no shared data");
        return;
    }
    Mesh const mesh = make_mesh(read_obj(path).meshes.at(0).soup);
    CHECK(mesh.closed());
    REQUIRE(mesh.shells.size() == 1);
    CHECK(mesh.shells[0].volume == 3.0);
}

TEST_CASE("bunny, spot and teapot are read as tinyobjloader reads them") {
    if (!fs::exists(shared / "models" / "obj")) {
        WARN("skipped: no shared data");
        return;
    }
    for (char const* name : {"bunny", "spot", "teapot"}) {
        INFO(name);
        fs::path const path = shared / "models" / "obj" / (std::string(name) + ".obj");
        check_against_tinyobjloader(path);
        Mesh const mesh = make_mesh(read_obj(path).meshes.at(0).soup);
        CHECK(mesh.closed() == (std::string(name) != "teapot"));
    }
}

TEST_CASE("an exported prism with negative indices has its glass and its mirror") {
    fs::path const path = shared / "models" / "blender-export" / "prism-ngon-negidx.obj";
    if (!fs::exists(path)) {
        WARN("skipped: no shared data");
        return;
    }
    Model const model = read_obj(path);
    REQUIRE(model.instances.size() == 2);
    CHECK(model.instances[0].name == "prism");
    CHECK(model.meshes[0].soup.face_names == std::vector<std::string>{"base", "sides_bk7", "sides_mirror"});
    Mesh const prism = make_mesh(model.meshes[0].soup);
    CHECK(prism.closed());
    CHECK(prism.shells.at(0).volume == Approx(1.0 / 3.0).epsilon(1e-15));
    CHECK(model.materials.at(0).ior == 1.5168);
    CHECK(model.materials.at(0).transmission == 1.0);
    CHECK(model.materials.at(1).metallic == 1.0);
    Mesh const hexagon = make_mesh(model.meshes[1].soup);
    CHECK(hexagon.soup.triangles.size() == 4); // one of its corners is hollow
    CHECK(hexagon.boundary_edges == 6);
}

TEST_CASE("a random OBJ file is read as tinyobjloader reads it") {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> coordinate(-100.0, 100.0);
    std::ostringstream text;
    text.precision(7);
    for (int i = 0; i < 3000; ++i)
        text << "v " << coordinate(random) << " " << coordinate(random) << " " << coordinate(random) << "\n";
    for (int i = 0; i < 5000; ++i) {
        text << "f";
        for (int c = 0; c < 3; ++c)
            text << " " << (random() % 2 ? 1 + int(random() % 3000) : -1 - int(random() % 3000));
        text << "\n";
    }
    TemporaryFolder const folder;
    folder.write("random.obj", text.str());
    check_against_tinyobjloader(folder.path / "random.obj");
}

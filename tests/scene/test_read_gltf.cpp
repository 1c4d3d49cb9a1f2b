// The models of this project, read and measured against the shapes that they stand for.
#include "geometry/mesh.h"
#include "scene/read_gltf.h"
#include "support/catch.h"

#include <cmath>
#include <filesystem>
#include <string>

using namespace sahl;

namespace {

constexpr double pi = 3.14159265358979323846;

Model read_own(std::string const& name) {
    return read_gltf(std::filesystem::path(SAHL_SOURCE_DIR) / "models" / name);
}

/// The volume of a biconvex lens: two caps and the cylinder between them.
double lens_volume(double radius, double thickness, double half) {
    double const sag = radius - std::sqrt(radius * radius - half * half);
    return 2.0 * pi * sag * sag * (radius - sag / 3.0) + pi * half * half * (thickness - 2.0 * sag);
}

} // namespace

TEST_CASE("every model of the project is closed, one body, and needs no repair") {
    for (char const* name : {"ball-320.glb", "ball-1280.glb", "ball-5120.glb", "ball-20480.glb",
                             "singlet-504.glb", "singlet-4104.glb", "singlet-15984.glb", "prism.gltf"}) {
        INFO(name);
        Model const model = read_own(name);
        CHECK(model.warnings.empty());
        REQUIRE(model.instances.size() == 1);
        CHECK(model.instances[0].to_world == Affine());
        Mesh const mesh = make_mesh(model.meshes[model.instances[0].mesh].soup);
        CHECK(mesh.closed());
        CHECK(mesh.flipped_triangles == 0);
        CHECK(mesh.degenerate_triangles == 0);
        REQUIRE(mesh.shells.size() == 1);
        CHECK(mesh.shells[0].sign == 1);
        for (ModelMaterial const& material : model.materials) {
            CHECK(material.ior == 1.5168);
            CHECK(material.transmission == 1.0);
            REQUIRE(material.volume);
            CHECK(material.volume->thickness_factor > 0.0);
            CHECK(material.warnings.empty());
        }
    }
}

TEST_CASE("a ball's vertices and normals are those of the sphere to a float's rounding") {
    Model const model = read_own("ball-1280.glb");
    TriangleSoup const& soup = model.meshes[0].soup;
    CHECK(soup.face_names == std::vector<std::string>{"surface"});
    CHECK(soup.triangles.size() == 1280);
    for (std::size_t i = 0; i < soup.positions.size(); ++i) {
        // each coordinate is off by at most half an ulp: 2^-24 of itself
        CHECK(std::abs(length(soup.positions[i]) - 0.005) < 0.005 * 0x1p-24 * std::sqrt(3.0));
        CHECK(std::abs(length(soup.normals[i]) - 1.0) < 1e-15);
        CHECK(length(soup.normals[i] - soup.positions[i] / 0.005) < 2.0 * 0x1p-24 * std::sqrt(3.0));
    }
}

TEST_CASE("finer meshes come nearer to their shapes, by four times as the edges halve") {
    double const ball = 4.0 / 3.0 * pi * std::pow(0.005, 3);
    double last = 1.0;
    for (char const* name : {"ball-320.glb", "ball-1280.glb", "ball-5120.glb", "ball-20480.glb"}) {
        double const error = 1.0 - make_mesh(read_own(name).meshes[0].soup).shells[0].volume / ball;
        if (last < 1.0)
            CHECK(last / error == Approx(4.0).margin(0.1)); // order 2, but for terms of order 4
        last = error;
    }
    double const lens = lens_volume(0.05, 0.01, 0.015);
    double const coarse = 1.0 - make_mesh(read_own("singlet-504.glb").meshes[0].soup).shells[0].volume / lens;
    double const fine = 1.0 - make_mesh(read_own("singlet-4104.glb").meshes[0].soup).shells[0].volume / lens;
    CHECK(coarse / fine == Approx(9.0).margin(0.1)); // 6 rings and 18
}

TEST_CASE("a lens has a front, a back and an edge, creased at the rims, in the frame of the exact lens") {
    Model const model = read_own("singlet-504.glb");
    TriangleSoup const& soup = model.meshes[0].soup;
    CHECK(soup.face_names == std::vector<std::string>{"front", "back", "edge"});
    Mesh const mesh = make_mesh(soup);
    CHECK(mesh.low.z == 0.0);
    CHECK(mesh.high.z == static_cast<double>(0.01f));
    CHECK(mesh.soup.positions.size() == soup.positions.size()); // no vertex is shared across a crease
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
        for (std::uint32_t const corner : soup.triangles[t]) {
            dvec3 const normal = soup.normals[corner];
            int const face = static_cast<int>(soup.triangle_face[t]);
            CHECK((face == 0 ? normal.z < -0.9 : face == 1 ? normal.z > 0.9 : normal.z == 0.0));
        }
}

TEST_CASE("the prism's faces are named and turned as those of the exact prism") {
    Model const model = read_own("prism.gltf");
    TriangleSoup const& soup = model.meshes[0].soup;
    CHECK(soup.face_names == std::vector<std::string>{"left", "right", "base", "near", "far"});
    double const c = std::sqrt(0.75);
    dvec3 const normals[] = {
        {-c, 0.5, 0.0}, {c, 0.5, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}};
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        auto const& [i, j, k] = soup.triangles[t];
        dvec3 const geometric =
            normalize(cross(soup.positions[j] - soup.positions[i], soup.positions[k] - soup.positions[i]));
        CHECK(length(geometric - normals[soup.triangle_face[t]]) < 1e-6);
        CHECK(length(soup.normals[i] - normals[soup.triangle_face[t]]) < 1e-7);
    }
    Mesh const mesh = make_mesh(soup);
    CHECK(mesh.high.y == Approx(0.0125 * std::sqrt(0.75)).epsilon(1e-6));
    CHECK(mesh.low.y == -mesh.high.y);
}

// Where points of surfaces lie on a picture, against the geometry of each, and how they move there.
#include "geometry/texture_place.h"
#include "support/catch.h"

#include <cmath>

using namespace sahl;

namespace {

bool near(dvec2 const& a, dvec2 const& b, double tolerance = 1e-14) {
    return length(a - b) < tolerance;
}

TriangleSoup textured_square() {
    TriangleSoup soup;
    soup.positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}};
    soup.triangle_face = {0, 0};
    soup.face_names = {"surface"};
    soup.texture_coordinates = {{vec2(0, 0), vec2(1, 0), vec2(1, 3)}, {vec2(0, 0), vec2(1, 3), vec2(0, 3)}};
    return soup;
}

} // namespace

TEST_CASE("on a mesh coordinates are linear between the corners, and go with triangles that are turned",
          "[geometry]") {
    TriangleSoup soup = textured_square();
    Mesh const mesh = make_mesh(soup);
    std::swap(soup.triangles[1][1], soup.triangles[1][2]);
    std::swap(soup.texture_coordinates[1][1], soup.texture_coordinates[1][2]);
    soup.triangles.insert(soup.triangles.begin(), {0, 0, 1}); // of no area
    soup.texture_coordinates.insert(soup.texture_coordinates.begin(), {vec2(9, 9), vec2(9, 9), vec2(9, 9)});
    soup.triangle_face.push_back(0);
    Mesh const turned = make_mesh(soup);
    for (Mesh const* const m : {&mesh, &turned}) {
        REQUIRE(m->soup.triangles.size() == 2);
        for (auto const& [triangle, point] :
             {std::pair{0U, dvec3(1.5, 0.25, 0)}, {1U, dvec3(0.5, 0.75, 0)}}) {
            auto const place = texture_place(*m, triangle, point);
            REQUIRE(place);
            CHECK(near(place->uv, {point.x / 2.0, 3.0 * point.y}));
            CHECK(near(place->moved({0.5, 0.0, 7.0}), {0.25, 0.0}));
            CHECK(near(place->moved({0.0, 0.5, 0.0}), {0.0, 1.5}));
        }
    }
    std::uint32_t const shell = 0;
    Mesh const part = part_of(mesh, {&shell, 1});
    CHECK(part.soup.texture_coordinates == mesh.soup.texture_coordinates);
    soup.texture_coordinates.clear();
    CHECK_FALSE(texture_place(make_mesh(soup), 0, dvec3(0.0)));
}

TEST_CASE("a picture lies once over a rectangle and each side of a box, upright from outside", "[geometry]") {
    Shape const rectangle = Rectangle{{4.0, 2.0}};
    CHECK(near(texture_place(rectangle, 0, {-2, -1, 0}, {0, 0, 1}).uv, {0, 0}));
    CHECK(near(texture_place(rectangle, 0, {2, 1, 0}, {0, 0, 1}).uv, {1, 1}));
    CHECK(near(texture_place(rectangle, 0, {1, 0, 0}, {0, 0, 1}, dvec2(0.5)).uv, {2.5, 0.5}));
    Shape const box = Box{{2.0, 4.0, 6.0}};
    for (dvec3 const n : {dvec3(1, 0, 0), dvec3(-1, 0, 0), dvec3(0, 1, 0), dvec3(0, -1, 0), dvec3(0, 0, 1),
                          dvec3(0, 0, -1)}) {
        TexturePlace const place = texture_place(box, 0, n * dvec3(1.0, 2.0, 3.0), n);
        CHECK(near(place.uv, {0.5, 0.5}));
        CHECK(dot(cross(place.across, place.up), n) > 0.0); // not mirrored
        CHECK(std::abs(dot(place.across, n)) + std::abs(dot(place.up, n)) == 0.0);
    }
    CHECK(near(texture_place(box, 0, {1, 2, -3}, {1, 0, 0}).uv, {1, 1}));
    CHECK(near(texture_place(box, 0, {1, 2, -3}, {0, 1, 0}).uv, {1, 1}));
}

TEST_CASE("round a sphere, a cylinder and a cone a picture lies once, and moves as differences do",
          "[geometry]") {
    struct Case {
        Shape shape;
        dvec3 point, normal;
    };
    double const s = std::sqrt(0.5);
    std::vector<Case> const cases{{Sphere{2.0}, dvec3(0.6, -1.2, std::sqrt(4.0 - 1.8)), {}},
                                  {Sphere{2.0}, dvec3(-1.0, 1.0, -std::sqrt(2.0)), {}},
                                  {Cylinder{1.0, 3.0}, dvec3(s, s, 0.7), {}},
                                  {Cone{2.0, 0.0, 2.0}, dvec3(-s, s, 0.0), {}}};
    for (Case const& c : cases) {
        TexturePlace const here = texture_place(c.shape, 0, c.point, c.normal);
        for (dvec3 const step : {dvec3(1e-6, 0, 0), dvec3(0, 1e-6, 0), dvec3(0, 0, 1e-6)}) {
            dvec2 const moved = texture_place(c.shape, 0, c.point + step, c.normal).uv - here.uv;
            CHECK(near(moved, here.moved(step), 1e-11)); // the square of the step
        }
    }
    CHECK(near(texture_place(Sphere{2.0}, 0, {0, 2, 0}, {}).uv, {0.75, 0.5}));
    CHECK(near(texture_place(Sphere{2.0}, 0, {0, 0, 2}, {}).uv, {0.5, 1.0}));
    CHECK(near(texture_place(Cylinder{1.0, 3.0}, 0, {1, 0, -1.5}, {}).uv, {0.5, 0.0}));
    CHECK(near(texture_place(Cylinder{1.0, 3.0}, 2, {1, 1, 1.5}, {0, 0, 1}).uv, {1.0, 1.0}));
}

// What a health report finds in meshes that were broken on purpose, and that it finds nothing in sound ones.
#include "geometry/mesh_health.h"
#include "support/catch.h"
#include "support/meshes.h"

#include <numbers>
#include <utility>

using namespace sahl;
using namespace sahl::bench;

namespace {

MeshHealth look_at(TriangleSoup soup) {
    return health_of(make_mesh(std::move(soup)), true);
}

void keep_first(TriangleSoup& soup, std::size_t triangles) {
    soup.triangles.resize(triangles);
    soup.triangle_face.resize(triangles);
}

TriangleSoup cube() {
    return box_soup(dvec3(0.0), dvec3(1.0));
}

} // namespace

TEST_CASE("a sound cube has nothing wrong, and twelve creases of its edges' length", "[health]") {
    MeshHealth const health = look_at(cube());
    CHECK(health.triangles == 12);
    CHECK(health.places == 8);
    CHECK(health.borders == 0);
    CHECK(health.crowded_edges.count == 0);
    CHECK(health.pinched_places.count == 0);
    CHECK(health.duplicates.count == 0);
    CHECK(health.slivers.count == 0);
    CHECK(health.creases == 12);
    CHECK(health.crease_length == Approx(12.0));
    CHECK(health.area == Approx(6.0));
    REQUIRE(health.shells.size() == 1);
    CHECK(health.shells[0].closed);
    CHECK(health.shells[0].volume == Approx(1.0));
    CHECK(health.normals.kind == NormalKind::none);
    REQUIRE(health.self_intersections);
    CHECK(health.self_intersections->count == 0);
}

TEST_CASE("a fine ball and a torus have no creases", "[health]") {
    CHECK(look_at(ball_soup(1.0, 3)).creases == 0);
    CHECK(look_at(torus_soup(3.0, 1.0, 48, 24)).creases == 0);
}

TEST_CASE("a hole is told by the length and the centre of its border", "[health]") {
    TriangleSoup soup = cube(); // its last two triangles are the side z = 1
    keep_first(soup, 10);
    MeshHealth const health = look_at(soup);
    REQUIRE(health.borders == 1);
    Border const& border = health.longest_borders.front();
    CHECK(border.edges == 4);
    CHECK(border.length == Approx(4.0));
    CHECK(length(border.centre - dvec3(0.5, 0.5, 1.0)) < 1e-15);
    CHECK_FALSE(health.shells[0].closed);
    CHECK(health.shells[0].volume == 0.0);
    CHECK_FALSE(health.torn()); // it is a box without a lid
}

TEST_CASE("a ball that lacks a triangle here and there is torn, and each hole is told apart", "[health]") {
    TriangleSoup soup = ball_soup(1.0, 3);
    for (std::size_t const t : {1000, 500, 20}) {
        soup.triangles.erase(soup.triangles.begin() + static_cast<std::ptrdiff_t>(t));
        soup.triangle_face.pop_back();
    }
    MeshHealth const health = look_at(soup);
    CHECK(health.borders == 3);
    CHECK(health.torn());
    for (Border const& border : health.longest_borders)
        CHECK(border.edges == 3);
    CHECK(health.longest_borders[0].length >= health.longest_borders[2].length);
}

TEST_CASE("a flat triangle that was left out leaves no hole", "[health]") {
    TriangleSoup soup =
        cube(); // the edge of the triangles 0 and 1 is split on one side, and closed by a flat one
    auto const middle = static_cast<std::uint32_t>(soup.positions.size());
    auto const [a, b, c] = soup.triangles[0];
    soup.positions.push_back(0.5 * (soup.positions[a] + soup.positions[c]));
    soup.triangles[0] = {a, b, middle};
    add_triangle(soup, middle, b, c);
    add_triangle(soup, a, middle, c);
    Mesh const mesh = make_mesh(soup);
    REQUIRE(mesh.closed());
    REQUIRE(mesh.degenerate_triangles == 1);
    MeshHealth const health = health_of(mesh);
    CHECK(health.borders == 0);
    CHECK(health.shells[0].closed);
    CHECK(health.creases == 12);
}

TEST_CASE("an edge of three triangles is found where it is", "[health]") {
    TriangleSoup soup = cube();
    soup.positions.push_back({0.5, 0.0, -1.0}); // a fin below the edge from (0, 0, 0) to (1, 0, 0)
    add_triangle(soup, 0, 1, 8);
    MeshHealth const health = look_at(soup);
    REQUIRE(health.crowded_edges.count == 1);
    CHECK(health.crowded_edges.places[0] == dvec3(0.5, 0.0, 0.0));
    CHECK(health.pinched_places.count == 0);
}

TEST_CASE("two bodies that touch at a corner pinch one place, and each is whole", "[health]") {
    MeshHealth const health = look_at(together(cube(), box_soup(dvec3(1.0), dvec3(2.0))));
    REQUIRE(health.pinched_places.count == 1);
    CHECK(health.pinched_places.places[0] == dvec3(1.0));
    CHECK(health.crowded_edges.count == 0);
    CHECK(health.borders == 0);
    CHECK(health.shells.size() == 2);
}

TEST_CASE("a bow tie of two open triangles pinches one place and has two borders", "[health]") {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    soup.positions = {{0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {-1, 1, 0}};
    add_triangle(soup, 0, 2, 1);
    add_triangle(soup, 0, 4, 3);
    MeshHealth const health = look_at(soup);
    CHECK(health.pinched_places.count == 1);
    CHECK(health.borders == 2);
}

TEST_CASE("a triangle that the file has twice is a duplicate, whichever way round it lies", "[health]") {
    for (bool const turned : {false, true}) {
        TriangleSoup soup = cube();
        auto const [a, b, c] = soup.triangles[3];
        turned ? add_triangle(soup, a, c, b) : add_triangle(soup, b, c, a);
        MeshHealth const health = look_at(soup);
        REQUIRE(health.duplicates.count == 1);
        CHECK(health.crowded_edges.count == 3);
    }
    TriangleSoup sheet; // one triangle with two sides
    sheet.face_names = {"surface"};
    sheet.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    add_triangle(sheet, 0, 1, 2);
    add_triangle(sheet, 0, 2, 1);
    CHECK(look_at(sheet).duplicates.count == 1);
    TriangleSoup tetrahedron; // each triangle has three neighbours
    tetrahedron.face_names = {"surface"};
    tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (auto const& t :
         std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
        add_triangle(tetrahedron, t[0], t[1], t[2]);
    CHECK(look_at(tetrahedron).duplicates.count == 0);
}

TEST_CASE("a sliver is a triangle of a height below a hundredth of its longest side", "[health]") {
    for (auto const& [height, slivers] : {std::pair(0.0099, 1), std::pair(0.0101, 0)}) {
        TriangleSoup soup;
        soup.face_names = {"surface"};
        soup.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, height, 0}};
        add_triangle(soup, 0, 1, 2);
        MeshHealth const health = look_at(soup);
        REQUIRE(health.slivers.count == static_cast<std::uint64_t>(slivers));
        CHECK(health.thinnest == Approx(slivers ? height : 0.0));
    }
}

TEST_CASE("a cavity is a shell that faces inwards, and is seen", "[health]") {
    TriangleSoup const inner = box_soup(dvec3(0.25), dvec3(0.5));
    MeshHealth const health = look_at(together(cube(), inside_out(inner)));
    REQUIRE(health.shells.size() == 2);
    CHECK(health.shells[0].winding_outside == 0);
    CHECK(health.shells[1].sign == -1);
    CHECK(health.shells[1].winding_outside == 1);
    CHECK(health.shells[1].volume == Approx(0.015625));
    CHECK_FALSE(health.shells[0].unseen());
    CHECK_FALSE(health.shells[1].unseen());
}

TEST_CASE("a cavity that faces outwards is a shell that light does not see", "[health]") {
    TriangleSoup const inner = box_soup(dvec3(0.25), dvec3(0.5));
    MeshHealth const health = look_at(together(cube(), inner));
    REQUIRE(health.shells.size() == 2);
    CHECK_FALSE(health.shells[0].unseen());
    CHECK(health.shells[1].unseen());
    // a body in a cavity of a body is seen
    MeshHealth const nested =
        look_at(together(together(box_soup(dvec3(-1.0), dvec3(2.0)), inside_out(cube())), inner));
    CHECK_FALSE(nested.shells[1].unseen());
    CHECK_FALSE(nested.shells[2].unseen());
}

TEST_CASE("two bodies that go through each other are found", "[health]") {
    MeshHealth const health = look_at(together(cube(), box_soup(dvec3(0.5, 0.5, 0.3), dvec3(1.5, 1.7, 0.8))));
    REQUIRE(health.self_intersections);
    CHECK(health.self_intersections->count > 0);
    CHECK_FALSE(health_of(make_mesh(cube())).self_intersections); // not looked for
}

TEST_CASE("a strip with one side only has an edge where its sides cannot agree", "[health]") {
    TriangleSoup strip;
    strip.face_names = {"surface"};
    std::uint32_t const steps = 24;
    for (std::uint32_t i = 0; i < steps; ++i) {
        double const u = 2.0 * std::numbers::pi * i / steps;
        for (double const side : {-0.3, 0.3})
            strip.positions.push_back({(1.0 + side * std::cos(0.5 * u)) * std::cos(u),
                                       (1.0 + side * std::cos(0.5 * u)) * std::sin(u),
                                       side * std::sin(0.5 * u)});
        bool const last = i + 1 == steps;
        std::uint32_t const a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
        add_triangle(strip, a, c, b);
        add_triangle(strip, b, c, d);
    }
    CHECK(look_at(strip).crowded_edges.count == 1);
}

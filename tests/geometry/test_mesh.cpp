// What make_mesh promises: welding, orientation, shells, cavities, and what it counts.
#include "geometry/mesh.h"
#include "geometry/mesh_topology.h"
#include "support/catch.h"

#include <cmath>
#include <utility>

using namespace sahl;

namespace {

void add(TriangleSoup& soup, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    soup.triangles.push_back({a, b, c});
    soup.triangle_face.push_back(0);
}

/// A cube of 12 triangles between two corners, its normals outwards.
TriangleSoup cube(dvec3 const& low, dvec3 const& high) {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    for (int i = 0; i < 8; ++i)
        soup.positions.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    std::uint32_t const sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (auto const& s : sides) {
        add(soup, s[0], s[1], s[2]);
        add(soup, s[0], s[2], s[3]);
    }
    return soup;
}

TriangleSoup unit_cube() {
    return cube(dvec3(0.0), dvec3(1.0));
}

TriangleSoup both(TriangleSoup soup, TriangleSoup const& other) {
    std::uint32_t const first = static_cast<std::uint32_t>(soup.positions.size());
    soup.positions.insert(soup.positions.end(), other.positions.begin(), other.positions.end());
    for (auto const& t : other.triangles)
        add(soup, first + t[0], first + t[1], first + t[2]);
    return soup;
}

TriangleSoup turned(TriangleSoup soup) {
    for (auto& t : soup.triangles)
        std::swap(t[1], t[2]);
    return soup;
}

/// Six times the volume that the triangles enclose, > 0 where they face outwards.
double signed_volume(TriangleSoup const& soup) {
    double sum = 0.0;
    for (auto const& t : soup.triangles)
        sum += dot(soup.positions[t[0]], cross(soup.positions[t[1]], soup.positions[t[2]])) / 6.0;
    return sum;
}

} // namespace

TEST_CASE("a cube is one closed shell of its volume") {
    Mesh const mesh = make_mesh(unit_cube());
    CHECK(mesh.closed());
    REQUIRE(mesh.shells.size() == 1);
    CHECK(mesh.shells[0].sign == 1);
    CHECK(mesh.shells[0].volume == Approx(1.0).epsilon(1e-15));
    CHECK(mesh.triangle_shell == std::vector<std::uint32_t>(12, 0));
    CHECK(mesh.low == dvec3(0.0));
    CHECK(mesh.high == dvec3(1.0));
    CHECK(mesh.flipped_triangles == 0);
    CHECK(mesh.degenerate_triangles == 0);
}

TEST_CASE("triangles that share no vertex are welded where their positions are equal, -0 and +0 alike") {
    TriangleSoup const shared = unit_cube();
    TriangleSoup apart;
    apart.face_names = {"surface"};
    for (auto const& t : shared.triangles) {
        std::uint32_t const first = static_cast<std::uint32_t>(apart.positions.size());
        for (std::uint32_t const corner : t) {
            dvec3 const& p = shared.positions[corner];
            apart.positions.push_back(first % 2 == 0 ? p : dvec3(p.x == 0.0 ? -0.0 : p.x, p.y, p.z));
        }
        add(apart, first, first + 1, first + 2);
    }
    Mesh const mesh = make_mesh(apart);
    CHECK(mesh.closed());
    CHECK(mesh.soup.positions.size() == 8);
    for (dvec3 const& p : mesh.soup.positions)
        CHECK_FALSE(std::signbit(p.x));
}

TEST_CASE("vertices with two normals stay two vertices, and the mesh is closed all the same") {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    TriangleSoup const shared = unit_cube();
    for (auto const& t : shared.triangles) {
        dvec3 const normal = normalize(cross(shared.positions[t[1]] - shared.positions[t[0]],
                                             shared.positions[t[2]] - shared.positions[t[0]]));
        std::uint32_t const first = static_cast<std::uint32_t>(soup.positions.size());
        for (std::uint32_t const corner : t) {
            soup.positions.push_back(shared.positions[corner]);
            soup.normals.push_back(normal);
        }
        add(soup, first, first + 1, first + 2);
    }
    Mesh const mesh = make_mesh(soup);
    CHECK(mesh.closed());
    CHECK(mesh.soup.positions.size() == 24);
    CHECK(mesh.soup.normals.size() == 24);
    CHECK(mesh.shells.size() == 1);
}

TEST_CASE("a triangle that lies the wrong way round is turned, its vertices' normals are not") {
    TriangleSoup soup = unit_cube();
    soup.normals.assign(8, dvec3(0.0, 0.0, 1.0));
    std::swap(soup.triangles[5][1], soup.triangles[5][2]);
    Mesh const mesh = make_mesh(soup);
    CHECK(mesh.flipped_triangles == 1);
    CHECK(mesh.closed());
    CHECK(signed_volume(mesh.soup) == Approx(1.0).epsilon(1e-15));
    for (dvec3 const& normal : mesh.soup.normals)
        CHECK(normal == dvec3(0.0, 0.0, 1.0));
}

TEST_CASE("a body that lies inside out is turned as a whole") {
    Mesh const mesh = make_mesh(turned(unit_cube()));
    CHECK(mesh.flipped_triangles == 12);
    CHECK(signed_volume(mesh.soup) == Approx(1.0).epsilon(1e-15));
    CHECK(mesh.shells[0].sign == 1);
}

TEST_CASE("the orientation of an inner component tells a cavity from a body within a body") {
    TriangleSoup const outer = unit_cube(), inner = cube(dvec3(0.25), dvec3(0.5));
    SECTION("a cavity") {
        Mesh const mesh = make_mesh(both(outer, turned(inner)));
        REQUIRE(mesh.shells.size() == 2);
        CHECK(mesh.shells[0].sign == 1);
        CHECK(mesh.shells[1].sign == -1);
        CHECK(mesh.shells[1].volume == Approx(0.015625).epsilon(1e-15));
        CHECK(mesh.flipped_triangles == 0);
    }
    SECTION("a body within a body") {
        Mesh const mesh = make_mesh(both(outer, inner));
        REQUIRE(mesh.shells.size() == 2);
        CHECK(mesh.shells[1].sign == 1);
    }
    SECTION("the same far from the origin, and the cavity first in the file") {
        dvec3 const far(1000.0, -2000.0, 500.0);
        TriangleSoup soup = both(turned(inner), outer);
        for (dvec3& p : soup.positions)
            p += far;
        Mesh const mesh = make_mesh(soup);
        REQUIRE(mesh.shells.size() == 2);
        CHECK(mesh.shells[0].sign == -1);
        CHECK(mesh.shells[1].sign == 1);
    }
    SECTION("beside the other it is no cavity") {
        Mesh const mesh = make_mesh(both(outer, turned(cube(dvec3(2.0), dvec3(3.0)))));
        CHECK(mesh.shells[1].sign == 1);
        CHECK(mesh.flipped_triangles == 12);
    }
}

TEST_CASE("a cube without a side is open, and says where by how many edges") {
    TriangleSoup soup = unit_cube();
    soup.triangles.resize(10);
    soup.triangle_face.resize(10);
    Mesh const mesh = make_mesh(soup);
    CHECK_FALSE(mesh.closed());
    CHECK(mesh.boundary_edges == 4);
    REQUIRE(mesh.shells.size() == 1);
    CHECK(mesh.shells[0].volume == 0.0);
    CHECK(mesh.flipped_triangles == 0);
}

TEST_CASE("triangles without area are dropped, and none of the surface is opened by it") {
    TriangleSoup soup = unit_cube();
    add(soup, 3, 3, 5); // two corners alike
    // the edge from 0 to 1 is cut at its middle on one side, and a triangle on a line closes the gap
    soup.positions.push_back({0.5, 0.0, 0.0});
    add(soup, 0, 8, 1);
    for (auto& t : soup.triangles)
        if (t == std::array<std::uint32_t, 3>{0, 1, 5}) {
            t = {0, 8, 5};
            break;
        }
    add(soup, 8, 1, 5);
    std::swap(soup.triangles[13][1], soup.triangles[13][2]); // 0, 1, 8: opposed to both
    Mesh const mesh = make_mesh(soup);
    CHECK(mesh.degenerate_triangles == 2);
    CHECK(mesh.closed());
    CHECK(mesh.soup.triangles.size() == 13);
    CHECK(signed_volume(mesh.soup) == Approx(1.0).epsilon(1e-15));
}

TEST_CASE("two cubes that share an edge have one edge of four triangles, and keep them all") {
    Mesh const mesh = make_mesh(both(unit_cube(), cube(dvec3(1.0, 1.0, 0.0), dvec3(2.0, 2.0, 1.0))));
    CHECK(mesh.non_manifold_edges == 1);
    CHECK(mesh.boundary_edges == 0);
    CHECK_FALSE(mesh.closed());
    CHECK(mesh.soup.triangles.size() == 24);
    CHECK(mesh.shells.size() == 1);
    CHECK(mesh.shells[0].volume == Approx(2.0).epsilon(1e-15));
}

TEST_CASE("two cubes that touch at a corner are two closed shells") {
    Mesh const mesh = make_mesh(both(unit_cube(), cube(dvec3(1.0), dvec3(2.0))));
    CHECK(mesh.closed());
    CHECK(mesh.shells.size() == 2);
    CHECK(mesh.soup.positions.size() == 15);
}

TEST_CASE("a strip with one side is left as it is, and is not closed") {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    int const steps = 12;
    for (int i = 0; i < steps; ++i) {
        double const angle = 2.0 * M_PI * i / steps;
        dvec3 const out(std::cos(angle), std::sin(angle), 0.0);
        dvec3 const across =
            0.2 * (std::cos(angle / 2.0) * out + std::sin(angle / 2.0) * dvec3(0.0, 0.0, 1.0));
        soup.positions.push_back(out - across);
        soup.positions.push_back(out + across);
    }
    for (std::uint32_t i = 0; i < steps; ++i) {
        bool const last = i + 1 == steps;
        std::uint32_t const a = 2 * i, b = 2 * i + 1, c = last ? 1 : 2 * i + 2, d = last ? 0 : 2 * i + 3;
        add(soup, a, b, c);
        add(soup, c, b, d);
    }
    Mesh const mesh = make_mesh(soup);
    CHECK(mesh.non_manifold_edges > 0);
    CHECK(mesh.flipped_triangles == 0);
    CHECK(mesh.soup.triangles == soup.triangles);
}

TEST_CASE("the list of edges finds what OpenMesh finds") {
    for (std::size_t const kept : {std::size_t{12}, std::size_t{11}, std::size_t{7}}) {
        TriangleSoup soup = unit_cube();
        soup.triangles.resize(kept);
        auto const by_openmesh = topology_of_manifold(soup.triangles, soup.positions.size());
        Topology const by_edges = topology_by_edges(soup.triangles);
        REQUIRE(by_openmesh);
        CHECK(by_openmesh->component == by_edges.component);
        CHECK(by_openmesh->open == by_edges.open);
        CHECK(by_openmesh->turned == by_edges.turned);
        CHECK(by_openmesh->boundary_edges == by_edges.boundary_edges);
        CHECK(by_edges.non_manifold_edges == 0);
    }
}

TEST_CASE("a polygon of 200 000 corners, as a fan, takes no quadratic time") {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    std::uint32_t const corners = 200'000;
    for (std::uint32_t i = 0; i < corners; ++i)
        soup.positions.push_back(
            {std::cos(2.0 * M_PI * i / corners), std::sin(2.0 * M_PI * i / corners), 0.0});
    for (std::uint32_t i = 1; i + 1 < corners; ++i)
        add(soup, 0, i, i + 1);
    Mesh const mesh = make_mesh(soup);
    CHECK(mesh.boundary_edges == corners);
    CHECK(mesh.shells.size() == 1);
}

TEST_CASE("no triangles at all make an empty mesh") {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    soup.positions = {dvec3(1.0)};
    Mesh const mesh = make_mesh(soup);
    CHECK(mesh.shells.empty());
    CHECK(mesh.soup.positions.empty());
}

// Meshes far finer than they need be, made of fewer triangles: what is kept, and how far off the rest lies.
#include "geometry/mesh_decimate.h"

#include "support/catch.h"
#include "support/curved.h"

#include <algorithm>
#include <cmath>
#include <set>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr double radius = 5e-3; // m

using Six = std::array<double, 6>;
Six vertex(TriangleSoup const& soup, std::size_t i) {
    dvec3 const &p = soup.positions[i], &n = soup.normals[i];
    return {p.x, p.y, p.z, n.x, n.y, n.z};
}

double from_segment(dvec3 const& p, dvec3 const& a, dvec3 const& b) {
    double const t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
    return length(p - a - t * (b - a));
}

double from_triangle(dvec3 const& p, dvec3 const& a, dvec3 const& b, dvec3 const& c) {
    dvec3 const n = cross(b - a, c - a);
    bool const over = dot(cross(n, b - a), p - a) >= 0.0 && dot(cross(n, c - b), p - b) >= 0.0 &&
                      dot(cross(n, a - c), p - c) >= 0.0;
    return over ? std::abs(dot(normalize(n), p - a))
                : std::min({from_segment(p, a, b), from_segment(p, b, c), from_segment(p, c, a)});
}

double from_mesh(dvec3 const& p, Mesh const& mesh) {
    double least = INFINITY;
    for (auto const& [a, b, c] : mesh.soup.triangles)
        least = std::min(
            least, from_triangle(p, mesh.soup.positions[a], mesh.soup.positions[b], mesh.soup.positions[c]));
    return least;
}

/// A cube of side 2 whose sides are grids, each with its own normals, and a face of its own for z = 1.
TriangleSoup gridded_cube(std::uint32_t n) {
    TriangleSoup soup;
    soup.face_names = {"sides", "top"};
    for (int axis = 0; axis < 3; ++axis)
        for (double const sign : {-1.0, 1.0}) {
            auto const first = static_cast<std::uint32_t>(soup.positions.size());
            for (std::uint32_t i = 0; i <= n; ++i)
                for (std::uint32_t j = 0; j <= n; ++j) {
                    dvec3 p, normal(0.0);
                    p[axis] = normal[axis] = sign;
                    p[(axis + 1) % 3] = 2.0 * i / n - 1.0;
                    p[(axis + 2) % 3] = 2.0 * j / n - 1.0;
                    soup.positions.push_back(p);
                    soup.normals.push_back(normal);
                }
            for (std::uint32_t i = 0; i < n; ++i)
                for (std::uint32_t j = 0; j < n; ++j) {
                    std::uint32_t const a = first + i * (n + 1) + j, b = a + n + 1;
                    for (auto t : {std::array{a, b, b + 1}, std::array{a, b + 1, a + 1}}) {
                        if (sign < 0.0)
                            std::swap(t[1], t[2]);
                        soup.triangles.push_back(t);
                        soup.triangle_face.push_back(axis == 2 && sign > 0.0 ? 1 : 0);
                    }
                }
        }
    return soup;
}

} // namespace

TEST_CASE("a decimated ball keeps vertices as they were, and what it leaves out lies within the tolerance",
          "[curved]") {
    constexpr double tolerance = 5e-5; // m: chords of 1.4 mm, where there are edges of 0.4
    auto const ball = float_ball(radius, 16);
    auto const fewer = decimated(*ball, tolerance);
    REQUIRE(fewer);
    CHECK(fewer->soup.triangles.size() < 2000);
    CHECK(fewer->closed());
    CHECK(fewer->shells.front().volume ==
          Approx(ball->shells.front().volume).epsilon(3.0 * tolerance / radius));
    Mesh const again = make_mesh(fewer->soup); // all that it says of itself holds of its triangles
    CHECK(again.closed());
    CHECK(again.flipped_triangles == 0);
    CHECK(again.soup.triangles.size() == fewer->soup.triangles.size());
    std::set<Six> known;
    for (std::size_t i = 0; i < ball->soup.positions.size(); ++i)
        known.insert(vertex(ball->soup, i));
    for (std::size_t i = 0; i < fewer->soup.positions.size(); ++i)
        CHECK(known.count(vertex(fewer->soup, i)) == 1);
    double worst = 0.0;
    for (dvec3 const& p : ball->soup.positions)
        worst = std::max(worst, from_mesh(p, *fewer));
    CHECK(worst <= tolerance * (1.0 + 1e-9));
    CHECK(worst > 0.3 * tolerance);
}

TEST_CASE("a decimated cube keeps its edges, its faces and the normals of each", "[curved]") {
    Mesh const cube = make_mesh(gridded_cube(12));
    auto const fewer = decimated(cube, 1e-6);
    REQUIRE(fewer);
    CHECK(fewer->soup.triangles.size() < cube.soup.triangles.size() / 2);
    CHECK(fewer->closed());
    CHECK(fewer->shells.front().volume == Approx(8.0).epsilon(1e-12));
    for (std::size_t t = 0; t < fewer->soup.triangles.size(); ++t) {
        auto const& [a, b, c] = fewer->soup.triangles[t];
        auto const& at = fewer->soup.positions;
        dvec3 const normal = normalize(cross(at[b] - at[a], at[c] - at[a]));
        for (std::uint32_t const corner : {a, b, c})
            CHECK(length(fewer->soup.normals[corner] - normal) < 1e-12);
        CHECK((fewer->face_of(static_cast<std::uint32_t>(t)) == 1) == (normal.z > 0.5));
    }
}

TEST_CASE("what is no manifold is not decimated, and a tolerance finer than the mesh takes nothing away",
          "[curved]") {
    TriangleSoup two = box_soup({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
    Mesh const touching = make_mesh(together(two, box_soup({1.0, 1.0, 0.0}, {2.0, 2.0, 1.0}))); // by an edge
    CHECK(!decimated(touching, 0.1));
    auto const same = decimated(*float_ball(radius, 8), 1e-9);
    REQUIRE(same);
    CHECK(same->soup.triangles.size() == 1280);
}

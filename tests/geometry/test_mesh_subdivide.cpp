// Meshes of more triangles, nearer to what they stand for: how near, and what is kept.
#include "geometry/mesh_subdivide.h"

#include "geometry/tessellate.h"
#include "support/catch.h"
#include "support/curved.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr double radius = 5e-3; // m

/// Of a ball about the origin: how far the triangles lie off it, at most.
double off_ball(Mesh const& mesh) {
    double worst = 0.0;
    constexpr int steps = 8;
    for (auto const& [a, b, c] : mesh.soup.triangles)
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                double const v = 1.0 * i / steps, w = 1.0 * j / steps;
                dvec3 const p = (1.0 - v - w) * mesh.soup.positions[a] + v * mesh.soup.positions[b] +
                                w * mesh.soup.positions[c];
                worst = std::max(worst, std::abs(length(p) - radius));
            }
    return worst;
}

double worst_normal(Mesh const& mesh, double sign) {
    double worst = 0.0;
    for (std::size_t i = 0; i < mesh.soup.positions.size(); ++i)
        worst = std::max(worst, length(mesh.soup.normals[i] - sign * normalize(mesh.soup.positions[i])));
    return worst;
}

} // namespace

TEST_CASE("a subdivided ball is as near to the sphere as was asked for, and closed", "[curved]") {
    auto const ball = float_ball(radius, 8); // 1280 triangles: their chords lie 4e-5 m below the sphere
    for (double const tolerance : {5e-6, 2e-7}) {
        auto const finer = subdivided(ball, tolerance);
        REQUIRE(finer);
        CHECK(finer->closed());
        CHECK(finer->shells.size() == 1);
        double const worst = off_ball(*finer);
        CHECK(worst < tolerance);
        CHECK(worst > 0.1 * tolerance); // halving takes a quarter: it is not far finer than it need be
        CHECK(worst_normal(*finer, 1.0) < 1e-5); // of patches so large
        auto const places = [](Mesh const& mesh) {
            std::set<std::array<double, 6>> all;
            for (std::size_t i = 0; i < mesh.soup.positions.size(); ++i) {
                dvec3 const &p = mesh.soup.positions[i], &n = mesh.soup.normals[i];
                all.insert({p.x, p.y, p.z, n.x, n.y, n.z});
            }
            return all;
        };
        auto const before = places(*ball), after = places(*finer); // what was there stays
        CHECK(std::includes(after.begin(), after.end(), before.begin(), before.end()));
    }
}

TEST_CASE("triangles are halved where the surface bends, and a cavity keeps its sense", "[curved]") {
    // a small ball of coarse triangles in a large one of fine ones: its own tolerance decides where
    auto const outer = double_ball(radius, 40), inner = double_ball(0.5 * radius, 6);
    TriangleSoup hollow = outer->soup;
    auto const first = static_cast<std::uint32_t>(hollow.positions.size());
    for (std::size_t i = 0; i < inner->soup.positions.size(); ++i) {
        hollow.positions.push_back(inner->soup.positions[i]);
        hollow.normals.push_back(-inner->soup.normals[i]);
    }
    for (auto const& [a, b, c] : inner->soup.triangles) {
        hollow.triangles.push_back({first + a, first + c, first + b});
        hollow.triangle_face.push_back(0);
    }
    auto const mesh = std::make_shared<Mesh const>(make_mesh(hollow));
    REQUIRE(mesh->shells.size() == 2);
    auto const finer = subdivided(mesh, 5e-6);
    REQUIRE(finer);
    CHECK(finer->closed());
    REQUIRE(finer->shells.size() == 2);
    std::size_t outside = 0, within = 0;
    for (std::size_t i = 0; i < finer->soup.positions.size(); ++i) {
        dvec3 const &p = finer->soup.positions[i], &n = finer->soup.normals[i];
        bool const cavity = length(p) < 0.75 * radius;
        ++(cavity ? within : outside);
        CHECK(dot(n, normalize(p)) * (cavity ? -1.0 : 1.0) > 0.99999);
    }
    CHECK(outside == first); // fine enough as it was
    CHECK(within > 3 * inner->soup.positions.size());
    CHECK(std::count_if(finer->shells.begin(), finer->shells.end(),
                        [](MeshShell const& shell) { return shell.sign < 0; }) == 1);
}

TEST_CASE("a subdivided lens keeps its faces, its creases and its volume", "[curved]") {
    Lens const lens{20e-3, -20e-3, 4e-3, 10e-3};
    TriangleSoup soup = tessellate(lens, 24).soup;
    std::size_t const coarse = soup.triangles.size();
    auto const mesh = std::make_shared<Mesh const>(make_mesh(std::move(soup)));
    auto const finer = subdivided(mesh, 1e-7);
    REQUIRE(finer);
    CHECK(finer->closed());
    CHECK(finer->soup.face_names == mesh->soup.face_names);
    CHECK(finer->soup.triangles.size() > 4 * coarse);
    // on the front face, the middle of each triangle off the sphere, in the rings that no crease bounds
    double worst = 0.0;
    std::size_t judged = 0;
    for (std::uint32_t t = 0; t < finer->soup.triangles.size(); ++t) {
        auto const& [a, b, c] = finer->soup.triangles[t];
        dvec3 const p =
            (finer->soup.positions[a] + finer->soup.positions[b] + finer->soup.positions[c]) / 3.0;
        if (finer->soup.face_names[finer->face_of(t)] != "front" || std::hypot(p.x, p.y) > 3.5e-3)
            continue;
        ++judged;
        worst = std::max(worst, std::abs(length(p - dvec3(0.0, 0.0, 20e-3)) - 20e-3));
    }
    CHECK(judged > 100);
    CHECK(worst < 1.2e-7); // the tolerance, and what a fit to so few triangles errs
}

TEST_CASE("a flat-faced mesh, one without normals and one that would grow too large keep their triangles",
          "[curved]") {
    TriangleSoup cube = box_soup({-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0});
    CHECK(!subdivided(std::make_shared<Mesh const>(make_mesh(cube)), 1e-9));
    TriangleSoup faces; // each triangle with its own normals
    for (auto const& [a, b, c] : cube.triangles) {
        auto const first = static_cast<std::uint32_t>(faces.positions.size());
        dvec3 const p = cube.positions[a], q = cube.positions[b], r = cube.positions[c];
        faces.positions.insert(faces.positions.end(), {p, q, r});
        faces.normals.insert(faces.normals.end(), 3, normalize(cross(q - p, r - p)));
        faces.triangles.push_back({first, first + 1, first + 2});
    }
    faces.triangle_face.assign(faces.triangles.size(), 0);
    faces.face_names = {""};
    auto const same = subdivided(std::make_shared<Mesh const>(make_mesh(faces)), 1e-9);
    REQUIRE(same);
    CHECK(same->soup.triangles.size() == cube.triangles.size());
    CHECK(!subdivided(float_ball(radius, 8), 1e-9, 5000));
}

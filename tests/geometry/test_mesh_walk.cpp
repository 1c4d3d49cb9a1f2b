// Thousands of bounces inside meshes: from faces, and from within rounding of edges and corners, at grazing
// angles, at any size and however far from the origin. A light pipe must not leak.
#include "geometry/bvh.h"
#include "optics/snell.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/meshes.h"

#include <limits>
#include <memory>
#include <string>
#include <vector>

using namespace sahl;
using namespace sahl::bench;

namespace {

using MeshRef = std::shared_ptr<Mesh const>;

struct Room {
    MeshRef mesh;
    Affine to_world;
    Bvh bvh;
    Room(MeshRef body, Affine const& place)
        : mesh(std::move(body)), to_world(place), bvh({PlacedGeometry{mesh, place, {0}, {0}, false, false}}) {
    }
};

/// Reflects the ray `bounces` times at what it meets; how many it made before it was lost.
int bounces_made(Room const& room, dvec3 origin, dvec3 direction, ShellSet const& inside, int bounces) {
    for (int made = 0; made < bounces; ++made) {
        NextHit const hit = room.bvh.next(origin, direction, inside, {});
        if (hit.proof == Proof::leak)
            return made;
        if (hit.at_one_place.empty()) // outside, a ray may go away
            return inside.empty() ? bounces : made;
        Crossing const& c = hit.at_one_place.front();
        if (c.enters == inside.contains(c.shell))
            return made;
        origin = c.point;
        direction = reflect(direction, dot(direction, c.normal) > 0.0 ? -c.normal : c.normal);
    }
    return bounces;
}

std::vector<std::pair<std::string, MeshRef>> rooms() {
    auto const made = [](TriangleSoup soup) {
        return std::make_shared<Mesh const>(make_mesh(std::move(soup)));
    };
    TriangleSoup const ball = ball_soup(1.0, 2);
    return {
        {"cube", made(box_soup(dvec3(-1.0), dvec3(1.0)))},
        {"light pipe", made(box_soup({-1.0, -0.01, -0.01}, {1.0, 0.01, 0.01}, true))},
        {"plate", made(box_soup({-1.0, -1.0, -1e-6}, {1.0, 1.0, 1e-6}))},
        {"ball", made(ball)},
        {"torus", made(torus_soup(1.0, 0.4, 24, 12))},
        {"bubble in a ball", made(together(ball, inside_out(ball_soup(0.5, 2))))},
    };
}

struct Start {
    dvec3 origin, direction;
};

/// At a point of a triangle, within `off` of it: 0 any point, 1 of an edge, 2 a corner.
Start draw_start(Mesh const& mesh, Dice& dice, int kind, bool inwards) {
    auto const& [i, j, k] = mesh.soup.triangles[dice.below(mesh.soup.triangles.size())];
    dvec3 const &a = mesh.soup.positions[i], &b = mesh.soup.positions[j], &c = mesh.soup.positions[k];
    double const u = kind == 2 ? 0.0 : dice.uniform(), v = kind == 0 ? dice.uniform() * (1.0 - u) : 0.0;
    dvec3 const normal = (inwards ? -1.0 : 1.0) * normalize(cross(b - a, c - a));
    double const off = dice.below(2) ? 0.0 : dice.log_between(1e-16, 1e-8);
    dvec3 const point = a + u * (b - a) + v * (c - a) + off * dice.direction();
    if (dice.below(2))
        return {point, dice.direction()};
    double const grazing = dice.log_between(1e-8, 1e-1);
    return {point, normalize(std::cos(grazing) * perpendicular_to(normal, dice.direction()) +
                             std::sin(grazing) * normal)};
}

/// Starts whose walk ended early.
int lost_walks(Room const& room, std::uint64_t seed, int starts, int bounces) {
    Dice dice(seed);
    int lost = 0;
    for (int k = 0; k < starts; ++k) {
        Start const start = draw_start(*room.mesh, dice, k % 3, k % 2);
        dvec3 const origin = room.to_world.point(start.origin);
        dvec3 const direction = normalize(room.to_world.vector(start.direction));
        ShellSet const inside = room.bvh.start_at(origin, direction).inside;
        lost += bounces_made(room, origin, direction, inside, bounces) != bounces;
    }
    return lost;
}

/// Rays from a point inside towards edges and corners, or to within rounding of them: reflected at one face,
/// they start where the next one is.
int lost_at_edges(Room const& room, std::uint64_t seed, int rays) {
    Dice dice(seed);
    int lost = 0;
    for (int k = 0; k < rays; ++k) {
        auto const& [i, j, l] = room.mesh->soup.triangles[dice.below(room.mesh->soup.triangles.size())];
        dvec3 const &a = room.mesh->soup.positions[i], &b = room.mesh->soup.positions[j],
                    &c = room.mesh->soup.positions[l];
        dvec3 const inner =
            (a + b + c) / 3.0 - 1e-3 * dice.uniform() * length(b - a) * normalize(cross(b - a, c - a));
        dvec3 const edge = k % 3 ? a + dice.uniform() * (b - a) : a;
        dvec3 const target = edge + (k % 2 ? dice.log_between(1e-17, 1e-13) : 0.0) * dice.direction();
        dvec3 const direction = normalize(room.to_world.vector(target - inner)),
                    origin = room.to_world.point(inner);
        ShellSet const inside = room.bvh.start_at(origin, direction).inside;
        lost += bounces_made(room, origin, direction, inside, 20) != 20;
    }
    return lost;
}

} // namespace

TEST_CASE("a ray that is reflected within rounding of an edge or a corner is not lost") {
    for (auto const& [name, mesh] : rooms()) {
        CAPTURE(name);
        CHECK(lost_at_edges(Room(mesh, {}), 5, 2000) == 0);
        Dice dice(6);
        CHECK(lost_at_edges(Room(mesh, {dice.rotation(), dice.direction()}), 7, 2000) == 0);
        CHECK(lost_at_edges(Room(mesh, {dice.rotation(), 1e3 * dice.direction()}), 8, 2000) == 0);
    }
}

TEST_CASE("a ray that is reflected inside or outside a mesh is never lost") {
    for (auto const& [name, mesh] : rooms()) {
        CAPTURE(name);
        CHECK(lost_walks(Room(mesh, {}), 1, 100, 200) == 0);
    }
}

TEST_CASE("nor in a walk of ten thousand bounces", "[slow]") {
    for (auto const& [name, mesh] : rooms()) {
        CAPTURE(name);
        CHECK(lost_walks(Room(mesh, {}), 2, 12, 10'000) == 0);
    }
}

TEST_CASE("nor in meshes that are turned, small, large or far away", "[slow]") {
    Dice dice(3);
    for (double scale : {1e-6, 1.0, 1e3})
        for (double offset : {0.0, 1e3, 1e5})
            for (auto const& [name, mesh] : rooms()) {
                CAPTURE(name, scale, offset);
                Affine const place{scale * dice.rotation(), scale * offset * dice.direction()};
                CHECK(lost_walks(Room(mesh, place), 4, 60, 200) == 0);
            }
}

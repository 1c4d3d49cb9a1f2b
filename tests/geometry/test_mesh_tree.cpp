// Straight lines through meshes, aimed where rays are lost: at vertices, at and along edges, along faces.
// What they are in at every stretch is compared with the mesh's winding number there.
#include "geometry/bvh.h"
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

MeshRef mesh_of(TriangleSoup soup) {
    return std::make_shared<Mesh const>(make_mesh(std::move(soup)));
}

std::vector<std::pair<std::string, MeshRef>> closed_meshes() {
    TriangleSoup const ball = ball_soup(1.0, 2);
    return {
        {"cube", mesh_of(box_soup(dvec3(-1.0), dvec3(1.0)))},
        {"cube, other diagonals", mesh_of(box_soup(dvec3(-1.0), dvec3(1.0), true))},
        {"plate", mesh_of(box_soup({-1.0, -1.0, -1e-6}, {1.0, 1.0, 1e-6}))},
        {"ball", mesh_of(ball)},
        {"torus", mesh_of(torus_soup(1.0, 0.4, 24, 12))},
        {"bubble in a ball", mesh_of(together(ball, inside_out(ball_soup(0.5, 2))))},
        {"bubble off the middle", mesh_of(together(ball, inside_out(ball_soup(0.25, 1, {0.5, 0.0, 0.0}))))},
        {"two balls", mesh_of(together(ball, ball_soup(0.7, 1, {2.0, 0.0, 0.0})))},
        {"overlapping balls", mesh_of(together(ball, ball_soup(1.0, 1, {1.0, 0.1, 0.2})))},
    };
}

struct Placement {
    MeshRef mesh;
    Affine to_world, to_local;
    double ulp; // local
    Bvh bvh;

    Placement(MeshRef body, Affine const& place, double scale)
        : mesh(std::move(body)), to_world(place), to_local(inverse(place)),
          ulp(std::numeric_limits<double>::epsilon() * (3.0 + length(place.offset) / scale)),
          bvh({PlacedGeometry{mesh, place, {0}, {0}, false, false}}) {}
};

struct Stretch {
    double from, to;
    ShellSet inside;
};

/// Follows the line to its end; nothing where it leaks, or is still in something at the end.
std::vector<Stretch> stretches(Placement const& placed, dvec3 const& origin, dvec3 const& direction) {
    Bvh::Start const start = placed.bvh.start_at(origin, direction);
    std::vector<Stretch> found{{0.0, INFINITY, start.inside}};
    while (found.size() < 100) {
        ShellSet inside = found.back().inside;
        NextHit const hit = placed.bvh.next(origin, direction, inside, {}, found.back().from);
        if (hit.proof == Proof::leak)
            return {};
        if (hit.at_one_place.empty())
            return inside.empty() ? found : std::vector<Stretch>{};
        for (Crossing const& c : hit.at_one_place) {
            if (c.enters == inside.contains(c.shell))
                return {};
            if (c.enters)
                inside.insert(c.shell);
            else
                inside.erase(c.shell);
        }
        found.back().to = hit.t;
        found.push_back({hit.t, INFINITY, inside});
    }
    return {};
}

/// Nearer to the surface than this, in local units, the winding number has its own rounding.
double distance_to(Mesh const& mesh, dvec3 const& p) {
    double nearest = INFINITY;
    for (auto const& [i, j, k] : mesh.soup.triangles) {
        dvec3 const &a = mesh.soup.positions[i], &b = mesh.soup.positions[j], &c = mesh.soup.positions[k];
        dvec3 const normal = normalize(cross(b - a, c - a));
        nearest = std::min(nearest, std::abs(dot(normal, p - a))); // of its plane: never too large
    }
    return nearest;
}

bool agrees_with_winding(Placement const& placed, dvec3 const& origin, dvec3 const& direction) {
    std::vector<Stretch> const found = stretches(placed, origin, direction);
    for (Stretch const& stretch : found) {
        double const t = stretch.to < INFINITY ? 0.5 * (stretch.from + stretch.to) : stretch.from + 1.0;
        dvec3 const local = placed.to_local.point(origin + t * direction);
        if (distance_to(*placed.mesh, local) < 1e3 * placed.ulp)
            continue;
        for (std::uint32_t shell = 0; shell < placed.mesh->shells.size(); ++shell)
            if (stretch.inside.contains({shell}) != (turns_round(*placed.mesh, shell, local) != 0))
                return false;
    }
    return !found.empty();
}

/// Points where lines go astray: 0 vertices, 1 edge midpoints, 2 points of edges, 3 of triangles, 4 anywhere.
dvec3 target(Mesh const& mesh, Dice& dice, int kind) {
    auto const& [i, j, k] = mesh.soup.triangles[dice.below(mesh.soup.triangles.size())];
    dvec3 const &a = mesh.soup.positions[i], &b = mesh.soup.positions[j], &c = mesh.soup.positions[k];
    switch (kind) {
    case 0:
        return a;
    case 1:
        return 0.5 * (a + b);
    case 2:
        return a + dice.uniform() * (b - a);
    case 3:
        return (a + b + c) / 3.0;
    default:
        return dice.in_box(mesh.low, mesh.high);
    }
}

/// Directions, local: 0 any, 1 through another such point, 2 along an edge, 3 in the plane of a triangle, 4
/// along an axis.
dvec3 heading(Mesh const& mesh, Dice& dice, int kind, dvec3 const& at) {
    auto const& [i, j, k] = mesh.soup.triangles[dice.below(mesh.soup.triangles.size())];
    dvec3 const &a = mesh.soup.positions[i], &b = mesh.soup.positions[j], &c = mesh.soup.positions[k];
    dvec3 axis(0.0);
    axis[static_cast<int>(dice.below(3))] = dice.sign();
    dvec3 const through = a - at;
    switch (kind) {
    case 0:
        return dice.direction();
    case 1:
        return length(through) > 1e-9 ? normalize(through) : dice.direction();
    case 2:
        return normalize(b - a);
    case 3:
        return normalize(dice.between(-1.0, 1.0) * (b - a) + dice.between(-1.0, 1.0) * (c - a) +
                         1e-3 * (b - a));
    default:
        return axis;
    }
}

int wrong_lines(Placement const& placed, double back, int count, std::uint64_t seed) {
    Dice dice(seed);
    int wrong = 0;
    for (int at = 0; at < 5; ++at)
        for (int to = 0; to < 5; ++to)
            for (int k = 0; k < count; ++k) {
                dvec3 const point = target(*placed.mesh, dice, at);
                dvec3 const direction = heading(*placed.mesh, dice, to, point);
                dvec3 const world = normalize(placed.to_world.vector(direction));
                wrong += !agrees_with_winding(placed, placed.to_world.point(point - back * direction), world);
            }
    return wrong;
}

} // namespace

TEST_CASE("lines aimed at vertices, edges and faces of a mesh are in what the winding number says") {
    for (auto const& [name, mesh] : closed_meshes()) {
        CAPTURE(name);
        CHECK(wrong_lines(Placement(mesh, {}, 1.0), 5.0, 40, 1) == 0);
    }
}

TEST_CASE("so are lines through meshes that are turned, small, large or far away", "[slow]") {
    Dice dice(2);
    for (double scale : {1e-3, 1.0, 1e3})
        for (double offset : {0.0, 1e3, 1e5})
            for (auto const& [name, mesh] : closed_meshes()) {
                CAPTURE(name, scale, offset);
                Affine const place{scale * dice.rotation(), scale * offset * dice.direction()};
                CHECK(wrong_lines(Placement(mesh, place, scale), 5.0, 10, 3) == 0);
            }
}

TEST_CASE("a line that starts on a mesh, in it or beyond it is in what the winding number says") {
    for (auto const& [name, mesh] : closed_meshes()) {
        CAPTURE(name);
        CHECK(wrong_lines(Placement(mesh, {}, 1.0), 0.0, 20, 4) == 0);
        CHECK(wrong_lines(Placement(mesh, {}, 1.0), 0.3, 20, 5) == 0);
        CHECK(wrong_lines(Placement(mesh, {}, 1.0), -5.0, 5, 6) == 0);
    }
}

TEST_CASE("a line finds the hole of an open mesh, and only that") {
    TriangleSoup soup = ball_soup(1.0, 2);
    auto const [a, b, c] = soup.triangles.back();
    dvec3 const corners[3] = {soup.positions[a], soup.positions[b], soup.positions[c]};
    dvec3 const middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    soup.triangles.pop_back();
    soup.triangle_face.pop_back();
    Placement const placed(mesh_of(soup), {}, 1.0);
    Dice dice(7);
    auto const through_hole = [&](dvec3 const& origin, dvec3 const& direction) { // the sign of three volumes
        int left = 0;
        for (int i = 0; i < 3; ++i)
            left += dot(direction, cross(corners[i] - origin, corners[(i + 1) % 3] - origin)) > 0.0;
        return left == 0 || left == 3;
    };
    int holes = 0;
    for (int k = 0; k < 4000; ++k) {
        dvec3 const direction = dice.direction();
        dvec3 const at = k % 2 ? middle + 0.2 * dice.direction() : dice.in_box(dvec3(-1.0), dvec3(1.0));
        dvec3 const origin = at - 5.0 * direction;
        bool const hole = through_hole(origin, direction);
        holes += hole;
        INFO(k);
        CHECK(stretches(placed, origin, direction).empty() == hole);
    }
    CHECK(holes > 100);
}

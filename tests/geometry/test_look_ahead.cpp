// What rays find that are asked about together, in packets or one after another, is what each of them finds
// alone, to the last bit: rays of a camera, aimed at
// vertices and along edges too, and what they become in glass, in scenes of meshes and exact shapes.
#include "geometry/mesh_tree.h"
#include "optics/snell.h"
#include "scene/interface.h"
#include "scene/read_obj.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"
#include "support/meshes.h"

#include <filesystem>

using namespace sahl;
using namespace sahl::bench;

namespace {

struct Going {
    dvec3 origin, direction;
    ShellSet inside;
    LeftSheets left;
};

struct Count {
    std::uint64_t asked = 0, known = 0, met = 0, different = 0;
};

bool same_sets(ShellSet const& a, ShellSet const& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

/// Bit for bit.
bool same(Interface const& a, Interface const& b) {
    return a.point == b.point && a.normal == b.normal && a.facet_normal == b.facet_normal && a.t == b.t &&
           a.face.value == b.face.value && a.primitive == b.primitive && a.surface == b.surface &&
           a.recovered == b.recovered && a.against_facing == b.against_facing &&
           a.body_before == b.body_before && a.body_after == b.body_after &&
           a.medium_after == b.medium_after && same_sets(a.inside_before, b.inside_before) &&
           same_sets(a.inside_after, b.inside_after) && a.left.size() == b.left.size();
}

enum class Way : std::uint8_t { in_packets, in_turn };

/// Asks of each ray alone and of all together; returns those that go on, refracted, and reflected.
std::vector<Going> compare(Scene const& scene, std::vector<Going> const& rays, Way way, Count& count) {
    std::vector<Going> refracted, reflected;
    for (std::size_t first = 0; first < rays.size(); first += Bvh::most_together) {
        std::size_t const size = std::min(Bvh::most_together, rays.size() - first);
        std::vector<Bvh::Line> lines;
        for (std::size_t i = first; i < first + size; ++i)
            lines.push_back({&rays[i].origin, &rays[i].direction, &rays[i].inside});
        std::vector<SeenAhead> seen(size);
        std::vector<SeenAhead*> places;
        for (SeenAhead& one : seen)
            places.push_back(&one);
        if (way == Way::in_packets)
            scene.bvh->look_ahead(lines, seen);
        else
            scene.bvh->look_ahead_in_turn(lines, places);
        for (std::size_t i = 0; i < size; ++i) {
            Going const& ray = rays[first + i];
            Interface alone, together;
            auto const body = body_at(scene, ray.inside);
            Meeting const expected =
                next_interface(scene, ray.origin, ray.direction, ray.inside, body, ray.left, alone);
            Meeting const found = next_interface(scene, ray.origin, ray.direction, ray.inside, body, ray.left,
                                                 together, &seen[i]);
            ++count.asked;
            count.known += seen[i].known;
            bool const met = expected == Meeting::interface;
            count.met += met;
            count.different += expected != found || (met && !same(alone, together));
            if (!met || alone.surface)
                continue;
            double const n1 = ray.inside.empty() ? 1.0 : 1.5;
            auto const through = refract(ray.direction, alone.normal, n1, 2.5 - n1);
            if (through)
                refracted.push_back({alone.point, *through, alone.inside_after, alone.left_by(true)});
            reflected.push_back({alone.point, reflect(ray.direction, alone.normal), alone.inside_before,
                                 alone.left_by(false)});
        }
    }
    refracted.insert(refracted.end(), reflected.begin(), reflected.end());
    return refracted;
}

/// From a place outside, towards all of a body, in small squares; the rays that follow are aimed at places
/// of its mesh where rounding counts.
std::vector<Going> camera_rays(Scene const& scene, Mesh const& mesh, Dice& dice, std::uint32_t side) {
    double const size = length(mesh.high - mesh.low);
    dvec3 const middle = 0.5 * (mesh.low + mesh.high), forward = dice.direction();
    dvec3 const at = middle - 1.7 * size * forward, right = perpendicular_to(forward),
                up = cross(right, forward);
    std::vector<Going> rays;
    auto const aim = [&](dvec3 const& target) {
        rays.push_back({at, normalize(target - at), scene.bvh->start_at(at, forward).inside, {}});
    };
    for (std::uint32_t tile = 0; tile < side * side / 16; ++tile)
        for (std::uint32_t i = 0; i < 16; ++i) {
            double const x = tile % (side / 4) * 4 + i % 4, y = tile / (side / 4) * 4 + i / 4;
            aim(middle + size * ((x / side - 0.5) * right + (y / side - 0.5) * up));
        }
    auto const& soup = mesh.soup;
    for (std::size_t t = 0; t < soup.triangles.size(); t += 1 + soup.triangles.size() / 400) {
        auto const& [a, b, c] = soup.triangles[t];
        dvec3 const p = soup.positions[a], q = soup.positions[b], r = soup.positions[c];
        for (int i = 0; i < 4; ++i) { // packets of vertices, points of edges, and what lies close to them
            aim(p);
            aim(glm::mix(p, q, dice.uniform()));
            aim(glm::mix(q, r, 0.5) + 1e-9 * size * dice.direction());
            aim(p + 1e-15 * size * dice.direction());
        }
    }
    return rays;
}

Count walk(Scene const& scene, Mesh const& mesh, Way way, std::uint64_t seed, std::uint32_t side) {
    REQUIRE((way == Way::in_packets ? scene.bvh->size_seen_ahead() > 0.0 : scene.bvh->looks_ahead_in_turn()));
    Dice dice(seed);
    Count count;
    for (int view = 0; view < 3; ++view) {
        std::vector<Going> rays = camera_rays(scene, mesh, dice, side);
        for (int step = 0; step < 4; ++step)
            rays = compare(scene, rays, way, count);
    }
    return count;
}

Scene with_neighbours(std::shared_ptr<Mesh const> const& mesh, bool sphere, bool floor, bool another) {
    Lab lab;
    MediumId const glass = lab.medium(1.5);
    double const size = length(mesh->high - mesh->low);
    dvec3 const middle = 0.5 * (mesh->low + mesh->high);
    if (sphere) // it overlaps the mesh
        lab.body("sphere", Sphere{0.2 * size}, glass, moved(middle + dvec3(0.2 * size)));
    if (floor)
        lab.sheet("floor", Rectangle{{9.0 * size, 9.0 * size}}, lab.surface(Paint{}),
                  moved(middle - dvec3(0.0, 0.0, 0.4 * size)));
    std::vector<MeshSpec> meshes{{"mesh", mesh, glass, {}, 0}};
    if (another) // far larger: they share no tree
        meshes.push_back({"shell",
                          std::make_shared<Mesh const>(make_mesh(ball_soup(12.0 * size, 2, middle))),
                          lab.medium(1.3),
                          {},
                          -1});
    return with_meshes(build_scene(lab.experiment), meshes);
}

} // namespace

TEST_CASE("what rays find together is what each finds alone", "[geometry]") {
    Way const way = GENERATE(Way::in_packets, Way::in_turn);
    std::vector<std::pair<std::string, TriangleSoup>> bodies{
        {"ball", geodesic_soup(5e-3, 40)},
        {"ball far from its origin", ball_soup(1.0, 4, {1e5, -2e5, 3e4})},
        {"torus", torus_soup(1.0, 0.4, 120, 60)},
        {"bubble in a ball", together(ball_soup(1.0, 3), inside_out(ball_soup(0.5, 3, {0.2, 0.1, 0.0})))},
        {"plate of 1e-6", box_soup({-1.0, -1.0, -5e-7}, {1.0, 1.0, 5e-7})},
    };
    std::filesystem::path const bunny = std::filesystem::path(SAHL_SOURCE_DIR) / "models/bunny.obj";
    if (std::filesystem::exists(bunny))
        bodies.emplace_back("bunny", read_obj(bunny).meshes.front().soup);
    for (auto& [name, soup] : bodies) {
        auto const mesh = std::make_shared<Mesh const>(make_mesh(std::move(soup)));
        for (int scene = 0; scene < 4; ++scene) {
            Count const count =
                walk(with_neighbours(mesh, scene == 1, scene == 2, scene == 3), *mesh, way, 11, 48);
            CAPTURE(static_cast<int>(way), name, scene, count.asked, count.met);
            CHECK(count.different == 0);
            CHECK(count.met > 5000);
            if (name == "ball" || name == "torus" || name == "bunny")
                // in turn only what is certain to ask about the mesh: of rays in a shell round it, few
                CHECK(count.known > count.asked / (way == Way::in_turn && scene == 3 ? 20 : 2));
        }
    }
}

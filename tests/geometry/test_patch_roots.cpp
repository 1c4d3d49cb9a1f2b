// Lines and patches of every shape: what is met, and how often.
#include "geometry/patch_roots.h"
#include "math/random.h"
#include "support/catch.h"
#include "support/curved_walk.h"

#include "scene/read_model.h"

#include <cmath>
#include <vector>

using namespace sahl;
using namespace sahl::bench;

namespace {

double any(std::uint64_t patch, std::uint64_t what) {
    return 2.0 * uniform(patch, what, 0, 0) - 1.0;
}

/// About a unit triangle; heights of up to `rough`.
void make_patch(Patch& patch, std::uint64_t seed, double rough) {
    std::uint64_t n = 0;
    auto const next = [&] { return any(seed, n++); };
    patch.corner = {next(), next(), next()};
    patch.to_second = {1.0 + 0.2 * next(), 0.2 * next(), 0.2 * next()};
    patch.to_third = {0.2 * next(), 1.0 + 0.2 * next(), 0.2 * next()};
    for (auto& up : patch.up) {
        dvec3 const direction = normalize(dvec3(0.4 * next(), 0.4 * next(), 1.0));
        up = {static_cast<float>(direction.x), static_cast<float>(direction.y),
              static_cast<float>(direction.z)};
    }
    for (float& height : patch.height)
        height = static_cast<float>(rough * next());
}

/// How often a line goes through a patch cut into facets.
std::size_t crossings_of_facets(Patch const& patch, dvec3 const& origin, dvec3 const& direction) {
    constexpr std::size_t n = 128;
    std::vector<dvec3> place((n + 1) * (n + 1));
    for (std::size_t i = 0; i <= n; ++i)
        for (std::size_t j = 0; i + j <= n; ++j)
            place[i * (n + 1) + j] =
                point_on(patch, static_cast<double>(i) / n, static_cast<double>(j) / n).place - origin;
    std::size_t crossings = 0;
    auto const look = [&](std::size_t a, std::size_t b, std::size_t c) {
        double const u = dot(direction, cross(place[c], place[b])),
                     v = dot(direction, cross(place[a], place[c])),
                     w = dot(direction, cross(place[b], place[a]));
        crossings += (u > 0.0) == (v > 0.0) && (v > 0.0) == (w > 0.0);
    };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; i + j < n; ++j) {
            std::size_t const at = i * (n + 1) + j;
            look(at, at + n + 1, at + 1);
            if (i + j + 1 < n)
                look(at + n + 1, at + n + 2, at + 1);
        }
    return crossings;
}

dvec3 direction_of(std::uint64_t ray, std::uint64_t step) {
    double const z = 2.0 * uniform(ray, step, 1, 0) - 1.0,
                 turn = 6.283185307179586 * uniform(ray, step, 1, 1);
    return {std::sqrt(1.0 - z * z) * std::cos(turn), std::sqrt(1.0 - z * z) * std::sin(turn), z};
}

} // namespace

TEST_CASE("a line meets a patch as often as its facets, smooth or wild, steeply or along it", "[curved]") {
    std::size_t met = 0, several = 0;
    for (std::uint64_t seed = 0; seed < 900; ++seed) {
        Patch patch;
        double const rough = seed % 3 == 0 ? 0.02 : seed % 3 == 1 ? 0.2 : 1.0;
        make_patch(patch, seed, rough);
        for (std::uint64_t line = 0; line < 4; ++line) {
            double const v = uniform(seed, 100 + line, 2, 0), w = (1.0 - v) * uniform(seed, 100 + line, 2, 1);
            dvec3 const aim = patch.corner + v * patch.to_second + w * patch.to_third +
                              dvec3(0.0, 0.0, 0.3 * rough * any(seed, 200 + line));
            double const steep = line % 2 == 0 ? 1.0 : 0.1;
            dvec3 const direction =
                normalize(dvec3(any(seed, 300 + line), any(seed, 310 + line), steep * any(seed, 320 + line)));
            dvec3 const origin = aim - 3.0 * direction;
            PatchRoots const roots = roots_of(patch, origin, direction, 0.0);
            CAPTURE(seed, line);
            CHECK(roots.size() == crossings_of_facets(patch, origin, direction));
            for (PatchRoot const& root : roots) {
                CHECK(length(point_on(patch, root.v, root.w).place - origin - root.t * direction) < 1e-14);
                CHECK(std::min({root.v, root.w, 1.0 - root.v - root.w}) >= 0.0);
            }
            met += roots.size();
            several += roots.size() > 1;
        }
    }
    CHECK(met > 2000);
    CHECK(several > 100);
}

TEST_CASE("a line within a flat patch meets nothing, and ends", "[curved]") {
    Patch patch;
    make_patch(patch, 1, 0.0);
    dvec3 const along = normalize(0.3 * patch.to_second + 0.7 * patch.to_third);
    CHECK(roots_of(patch, patch.corner - along, along, 1e-3).size() <= 2);
}

TEST_CASE("light goes in and out of the scanned bunny's fitted surface and none is lost", "[curved]") {
    auto models = read_model(SAHL_SOURCE_DIR "/models/bunny.glb");
    auto const mesh = std::make_shared<Mesh const>(make_mesh(std::move(models.meshes.at(0).soup)));
    CurvedTree const tree(mesh, PatchKind::fitted);
    double const rounding = 64.0 * 0x1p-52 * length(glm::max(glm::abs(mesh->low), glm::abs(mesh->high)));
    CHECK(tree.share_stood_in() > 0.5); // it is rough: most of what is fitted would stray somewhere
    CHECK(tree.share_stood_in() < 0.9);

    SECTION("in walks of many crossings") {
        CurvedWalk count;
        for (std::uint64_t ray = 0; count.hits < 20000; ++ray)
            count.walk(tree, ray, 40, rounding);
        CHECK(count.leaks == 0);
        CHECK(count.recovered == 0);
        CHECK(count.crooked == 0);
    }

    SECTION("each line as often in as out, and its next crossing is the nearest of all patches'") {
        double const size = length(mesh->high - mesh->low);
        std::size_t crossed = 0;
        for (std::uint64_t ray = 0; ray < 40; ++ray) {
            dvec3 const from = 0.5 * (mesh->low + mesh->high) + size * direction_of(ray, 0);
            dvec3 const along =
                normalize(0.5 * (mesh->low + mesh->high) + 0.2 * size * direction_of(ray, 1) - from);
            int balance = 0;
            double nearest = INFINITY;
            for (std::uint32_t t = 0; t < mesh->soup.triangles.size(); ++t)
                for (PatchRoot const& root : roots_of(tree.patch(t), from, along, 0.0)) {
                    bool const enters = dot(root.outward, along) < 0.0;
                    balance += enters ? 1 : -1;
                    if (enters)
                        nearest = std::min(nearest, root.t);
                }
            CAPTURE(ray);
            CHECK(balance == 0);
            auto const next = tree.next(from, along, {{}, {0}}, {0.0, INFINITY}, rounding).crossing;
            REQUIRE(next.has_value() == (nearest < INFINITY));
            if (next) {
                CHECK(std::abs(next->t - nearest) * next->slope < 4.0 * rounding);
                ++crossed;
            }
        }
        CHECK(crossed > 20);
    }
}

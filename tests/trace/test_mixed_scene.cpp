// A scene of touching, overlapping and nested bodies with mirrors and detectors glued to them, built of exact
// shapes, and the same with some of them as meshes, instances of one mesh, mirrored ones: light must not see
// the difference.
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"
#include "support/meshes.h"

#include <algorithm>
#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

struct Block {
    dvec3 low, high;
    double index;
};

/// What is a mesh: one bit a block.
Traced traced(std::vector<Block> const& blocks, std::uint32_t meshes, Affine const& frame, bool polished,
              std::uint64_t seed) {
    Lab lab(1.0);
    auto const unit = std::make_shared<Mesh const>(make_mesh(box_soup(dvec3(-0.5), dvec3(0.5))));
    auto const other = std::make_shared<Mesh const>(make_mesh(box_soup(dvec3(-0.5), dvec3(0.5), true)));
    std::vector<MeshSpec> specs;
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
        auto const& [low, high, index] = blocks[i];
        dvec3 const size = high - low, middle = 0.5 * (low + high);
        std::string const name = "block " + std::to_string(i);
        int const priority = static_cast<int>(i);
        if (meshes >> i & 1) { // all are instances of two meshes; every third is mirrored
            Affine place{dmat3({i % 3 ? size.x : -size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}), middle};
            specs.push_back({name, i % 2 ? unit : other, lab.medium(index), compose(frame, place), priority});
        } else {
            lab.body(name, Box{size}, lab.medium(index), compose(frame, moved(middle)), priority);
        }
    }
    if (polished) {
        // a half mirror on a face in common, a mirror on an outer face, a window within, a screen glued to a
        // face
        lab.sheet("half", Rectangle{{0.5, 0.5}}, lab.surface(Shares{0.5, 0.5}),
                  compose(frame, facing({0.0, 0.5, 0.0}, {0.0, 1.0, 0.0})));
        lab.sheet("mirror", Disk{0.4}, lab.surface(Shares{0.9, 0.0}),
                  compose(frame, facing({0.5, 0.5, 1.0}, {0.0, 0.0, 1.0})));
        lab.detector("window", compose(frame, facing({0.5, 0.5, 0.25}, {0.0, 0.0, 1.0})), {0.6, 0.6}, false);
        lab.detector("screen", compose(frame, facing({1.0, 0.5, 0.5}, {-1.0, 0.0, 0.0})), {0.5, 0.5});
    }
    Dice dice(seed);
    std::vector<RaySpec> rays;
    for (int k = 0; k < 150; ++k) {
        dvec3 const target = dice.in_box(dvec3(-1.0), dvec3(1.0)), d = dice.direction();
        rays.push_back({frame.point(target - (k % 2 ? 4.0 : 0.3) * d), frame.vector(d)});
    }
    lab.rays(rays);
    lab.experiment.trace.min_power = 1e-3;
    return trace(with_meshes(build_scene(lab.experiment), specs), lab.experiment.trace);
}

} // namespace

TEST_CASE(
    "mirrors, detectors, instances, meshes and exact shapes in contact are traced alike, whichever is which",
    "[trace]") {
    // eight cubes about the origin, a slab through them of higher priority, a core with a corner at the
    // origin
    std::vector<Block> blocks;
    for (int k = 0; k < 8; ++k) {
        dvec3 const low(k & 1 ? 0.0 : -1.0, k & 2 ? 0.0 : -1.0, k & 4 ? 0.0 : -1.0);
        blocks.push_back({low, low + 1.0, 1.3 + 0.07 * k});
    }
    blocks.push_back({{-1.0, -1.0, -0.3}, {1.0, 1.0, 0.0}, 1.9});
    blocks.push_back({dvec3(0.0), dvec3(0.5), 1.1});
    blocks.push_back({{0.0, 0.0, 0.5}, {0.5, 0.5, 0.75}, 1.3}); // as the cube round it, but for rounding
    Dice dice(21);
    for (std::uint64_t k = 0; k < 12; ++k) {
        Affine const frame = k % 4 ? Affine{dice.rotation(), dice.direction()} : Affine{};
        bool const polished = k % 2;
        Traced const exact = traced(blocks, 0, frame, polished, k);
        auto const meshes = static_cast<std::uint32_t>(k ? dice.below(2048) : 2047);
        Traced const mixed = traced(blocks, meshes, frame, polished, k);
        CAPTURE(k, meshes);
        for (Traced const* one : {&exact, &mixed}) {
            CHECK(one->ended(Event::leak) + one->ended(Event::invalid) == 0);
            CHECK(std::abs(one->result.tally.remainder()) <= 1e-12);
        }
        REQUIRE(exact.segments().size() == mixed.segments().size());
        std::size_t different = 0;
        for (std::size_t i = 0; i < exact.segments().size(); ++i) {
            Segment const &a = exact.segments()[i], &b = mixed.segments()[i];
            bool const as_long = a.length == b.length || std::abs(a.length - b.length) < 1e-10;
            different += a.ray != b.ray || a.index != b.index || a.ended != b.ended || !as_long ||
                         length(a.direction - b.direction) > 1e-10 ||
                         std::abs(a.power_end - b.power_end) > 1e-10;
        }
        CHECK(different == 0);
        REQUIRE(exact.result.hits.size() == mixed.result.hits.size());
        for (std::size_t i = 0; i < exact.result.hits.size(); ++i)
            CHECK(length(exact.result.hits[i].at - mixed.result.hits[i].at) < 1e-10);
        CHECK((!polished || exact.result.hits.size() > 20));
    }
}

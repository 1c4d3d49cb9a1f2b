// Meshes that share a tree are met as they are one by one: walks through a cemented doublet, a body that
// overlaps it and one beside it, mirrored, turned and scaled.
#include "geometry/bvh.h"
#include "geometry/mesh_cluster.h"
#include "optics/snell.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/lathe.h"
#include "support/meshes.h"

#include <memory>

using namespace sahl;
using namespace sahl::bench;

namespace {

using Meshes = std::vector<std::shared_ptr<Mesh const>>;

Meshes doublet_and_others() {
    auto const mesh = [](TriangleSoup soup, double shift) {
        for (dvec3& p : soup.positions)
            p.z += shift;
        return std::make_shared<Mesh const>(make_mesh(std::move(soup)));
    };
    return {mesh(lens_soup(60e-3, -45e-3, 6e-3, 10e-3, 12, 40), 0.0),
            mesh(lens_soup(-45e-3, -130e-3, 3e-3, 10e-3, 12, 40), 6e-3),
            mesh(geodesic_soup(4e-3, 9), 8e-3), // overlaps the flint
            mesh(box_soup({12e-3, -5e-3, -5e-3}, {20e-3, 5e-3, 5e-3}, true), 0.0)};
}

/// The same bodies; of those that have a twin far away no tree holds several.
Bvh scene_of(Meshes const& meshes, Affine const& place, bool with_twins) {
    std::vector<PlacedGeometry> geometries;
    for (double far : {0.0, 1e6})
        for (std::uint32_t k = 0; k < meshes.size() && (far == 0.0 || with_twins); ++k) {
            auto const number = static_cast<std::uint32_t>(geometries.size());
            Affine there = place;
            there.offset.x += far;
            geometries.push_back({meshes[k], there, {number}, {number}, false, false});
            if (with_twins && geometries.size() == 6) // more would be met through a tree of boxes
                break;
        }
    return Bvh(std::move(geometries));
}

} // namespace

TEST_CASE("meshes that share a tree are met as one by one", "[geometry]") {
    Dice dice(5);
    for (int placing = 0; placing < 4; ++placing) {
        dmat3 turn = placing ? dice.rotation() : dmat3(1.0);
        if (placing == 2)
            turn[0] = -turn[0]; // mirrored
        double const scale = placing == 3 ? 1e3 : 1.0;
        Affine const place{scale * turn, placing ? scale * dice.direction() : dvec3(0.0)};
        Meshes meshes = doublet_and_others();
        meshes.resize(placing % 2 ? 2 : 3); // with twins: 4 and 6 bodies
        Bvh const together = scene_of(meshes, place, false), apart = scene_of(meshes, place, true);
        int hits = 0, at_two = 0, different = 0;
        for (int ray = 0; ray < 10000; ++ray) {
            dvec3 origin = place.point(dice.in_box(dvec3(-11e-3, -11e-3, -2e-3), dvec3(11e-3, 11e-3, 13e-3)));
            dvec3 direction = dice.direction();
            ShellSet inside = together.start_at(origin, direction).inside;
            for (int step = 0; step < 12; ++step) {
                NextHit const one = together.next(origin, direction, inside, {});
                NextHit const other = apart.next(origin, direction, inside, {});
                bool const met = !one.at_one_place.empty();
                bool same = one.proof == other.proof &&
                            one.at_one_place.size() == other.at_one_place.size() &&
                            (!met || std::abs(one.t - other.t) <= one.blur);
                for (std::size_t i = 0; same && i < one.at_one_place.size(); ++i)
                    same = one.at_one_place[i].shell == other.at_one_place[i].shell &&
                           one.at_one_place[i].primitive == other.at_one_place[i].primitive;
                different += !same;
                if (!met)
                    break;
                ++hits;
                at_two += one.at_one_place.size() > 1;
                bool const through = dice.below(3) > 0;
                for (Crossing const& c : one.at_one_place)
                    if (through && c.enters)
                        inside.insert(c.shell);
                    else if (through)
                        inside.erase(c.shell);
                origin = one.at_one_place.front().point;
                dvec3 const normal = one.at_one_place.front().normal;
                if (!through)
                    direction =
                        normalize(reflect(direction, dot(direction, normal) > 0.0 ? -normal : normal));
            }
        }
        CAPTURE(placing, hits);
        CHECK(hits > 10000);
        CHECK(at_two > 100);
        CHECK(different == 0);
    }
}

TEST_CASE("meshes of like size that are there once share a tree", "[geometry]") {
    Meshes const meshes = doublet_and_others();
    auto const placed = [&](std::size_t k, double scale) {
        PlacedGeometry geometry{meshes[k], {dmat3(scale), dvec3(0.0)}, {0}, {0}, false, false};
        return place(std::move(geometry), MeshMeeting{std::make_shared<MeshTree const>(meshes[k])});
    };
    std::vector<Placed> const alike{placed(0, 1.0), placed(1, 1.0)};
    auto const cluster = MeshCluster::of(alike);
    REQUIRE(cluster);
    CHECK((cluster->holds(0) && cluster->holds(1)));
    std::vector<Placed> const unlike{placed(0, 1.0), placed(1, 100.0)};
    CHECK_FALSE(MeshCluster::of(unlike));
    std::vector<Placed> const instances{alike[0], alike[0], alike[1]};
    CHECK_FALSE(MeshCluster::of(instances));
}

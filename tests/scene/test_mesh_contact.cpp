// Meshes in contact, with each other and with exact shapes: one boundary where faces lie on each other,
// whatever their triangles; two where there is a gap.
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"
#include "support/meshes.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

using MeshRef = std::shared_ptr<Mesh const>;

MeshRef mesh_of(TriangleSoup soup) {
    return std::make_shared<Mesh const>(make_mesh(std::move(soup)));
}

/// The media along a ray's path where it goes straight through.
std::vector<std::uint32_t> media_of(Traced const& traced, std::uint64_t ray) {
    std::vector<std::uint32_t> media;
    std::int32_t next = -1;
    for (Segment const& segment : traced.segments())
        if (segment.ray == ray && segment.parent == next && segment.born != Event::reflected) {
            media.push_back(segment.medium);
            next = static_cast<std::int32_t>(segment.index);
        }
    return media;
}

/// Rays from above through the middle of both blocks, some along the axis, some aimed at corners and edges of
/// triangles.
std::vector<RaySpec> rays_from_above(Affine const& group, Dice& dice, int count) {
    std::vector<RaySpec> rays;
    for (int k = 0; k < count; ++k) {
        dvec3 at(dice.between(-0.09, 0.09), dice.between(-0.09, 0.09), 0.0);
        if (k % 4 == 0)
            at.y = at.x; // a diagonal
        if (k % 4 == 1)
            at.y = -at.x;
        dvec3 const direction =
            k % 3 ? normalize(dvec3(0.05 * dice.between(-1.0, 1.0), 0.05 * dice.between(-1.0, 1.0), -1.0))
                  : dvec3(0.0, 0.0, -1.0);
        rays.push_back({group.point(at - 1.0 * direction), normalize(group.vector(direction))});
    }
    return rays;
}

/// Two blocks, the upper one's underside at z = gap.
Traced two_blocks(Affine const& group, double gap, bool lower_exact, Dice& dice) {
    Lab lab;
    MediumId const one = lab.medium(1.5), two = lab.medium(1.7);
    if (lower_exact)
        lab.body("lower", Box{{0.3, 0.3, 0.1}}, one, compose(group, moved({0.0, 0.0, -0.05})));
    lab.rays(rays_from_above(group, dice, 100));
    lab.experiment.trace.min_power = 1e-2;
    std::vector<MeshSpec> meshes;
    if (!lower_exact)
        meshes.push_back({"lower", mesh_of(box_soup({-0.15, -0.15, -0.1}, {0.15, 0.15, 0.0})), one, group});
    meshes.push_back({"upper", mesh_of(box_soup({-0.1, -0.1, 0.0}, {0.1, 0.1, 0.2}, true)), two,
                      compose(group, moved({0.0, 0.0, gap}))});
    return trace(with_meshes(build_scene(lab.experiment), meshes), lab.experiment.trace);
}

} // namespace

TEST_CASE("block on block is one boundary, with any triangles and in any group, a gap makes two") {
    Dice dice(1);
    for (bool lower_exact : {false, true})
        for (double gap : {0.0, 1e-12, 1e-6})
            for (int k = 0; k < 10; ++k) {
                Affine const group =
                    k ? Affine{dice.rotation(), dice.in_box(dvec3(-1.0), dvec3(1.0))} : Affine{};
                Traced const traced = two_blocks(group, gap, lower_exact, dice);
                CAPTURE(lower_exact, gap, k);
                CHECK(traced.ended(Event::leak) == 0);
                int wrong = 0;
                for (std::uint64_t ray = 0; ray < 100; ++ray)
                    wrong +=
                        media_of(traced, ray) != (gap == 0.0 ? std::vector<std::uint32_t>{0, 2, 1, 0}
                                                             : std::vector<std::uint32_t>{0, 2, 0, 1, 0});
                CHECK(wrong == 0);
            }
}

TEST_CASE("a detector and a mirror on a mesh's face are met before it") {
    Dice dice(2);
    for (bool mirror : {false, true})
        for (int k = 0; k < 20; ++k) {
            Affine const group = k ? Affine{dice.rotation(), dice.in_box(dvec3(-1.0), dvec3(1.0))} : Affine{};
            Lab lab;
            MediumId const glass = lab.medium(1.5);
            if (mirror)
                lab.sheet("mirror", Rectangle{{0.4, 0.4}}, lab.surface(Shares{1.0, 0.0}), group);
            lab.detector("glued", compose(group, facing({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0})), {0.4, 0.4},
                         false);
            dvec3 const up = normalize(dvec3(0.01, 0.02, 1.0));
            lab.rays({{group.point({0.01, 0.02, -0.05}), normalize(group.vector(up))}});
            lab.experiment.trace.max_depth = 2;
            MeshRef const block = mesh_of(box_soup({-0.15, -0.15, -0.1}, {0.15, 0.15, 0.0}));
            Traced const traced =
                trace(with_meshes(build_scene(lab.experiment), {{"block", block, glass, group}}),
                      lab.experiment.trace);
            CAPTURE(mirror, k);
            REQUIRE(traced.result.hits.size() == 1);
            REQUIRE(traced.segments().size() > 2);
            CHECK(traced.segments()[0].ended == Event::passed);
            CHECK(traced.segments()[0].medium == glass.value);
            CHECK(traced.segments()[1].ended == (mirror ? Event::reflected : Event::refracted));
            CHECK(traced.segments()[1].medium == glass.value);
            CHECK(traced.ended(Event::leak) == 0);
        }
}

TEST_CASE("two halves of a ball that were cut from one mesh are one boundary") {
    // a cemented doublet as a file has it: the faces between its halves are there twice
    TriangleSoup const torus = torus_soup(0.3, 0.15, 24, 16);
    Dice dice(3);
    Affine const group{dice.rotation(), dice.direction()};
    Lab lab;
    MediumId const inner = lab.medium(1.5), outer = lab.medium(1.6);
    std::vector<RaySpec> rays;
    for (int k = 0; k < 300; ++k) {
        dvec3 const target = torus.positions[dice.below(torus.positions.size())];
        dvec3 const aim = k % 2 ? target : target + 0.03 * dice.direction(), direction = dice.direction();
        rays.push_back({group.point(aim - 3.0 * direction), group.vector(direction)});
    }
    lab.rays(rays);
    lab.experiment.trace.min_power = 1e-2;
    std::vector<MeshSpec> const meshes{
        {"core", mesh_of(torus), inner, group},
        {"coat", mesh_of(together(ball_soup(1.0, 2), inside_out(torus))), outer, group},
    };
    Traced const traced = trace(with_meshes(build_scene(lab.experiment), meshes), lab.experiment.trace);
    CHECK(traced.ended(Event::leak) == 0);
    CHECK(traced.ended(Event::invalid) == 0);
    int slipped = 0; // air where there is none
    for (Segment const& s : traced.segments())
        slipped += s.parent >= 0 && s.medium == 0 && s.ended != Event::escaped &&
                   s.ended != Event::cut_power && length(inverse(group).point(s.origin)) < 0.9;
    CHECK(slipped == 0);
    CHECK(std::abs(traced.result.tally.remainder()) < 1e-12);
}

TEST_CASE("rays that are met within rounding alone are counted as recovered, not lost") {
    // total reflection close to the edges of a block that is turned: where a ray starts beyond the next face
    Dice dice(4);
    Affine const group{dice.rotation(), dice.direction()};
    Lab lab;
    MediumId const glass = lab.medium(2.5);
    std::vector<RaySpec> rays;
    for (int k = 0; k < 1000; ++k) {
        dvec3 const edge(dice.between(-0.1, 0.1), k % 2 ? 0.1 : -0.1, k % 4 < 2 ? 0.1 : -0.1),
            from = 0.09 * dice.direction();
        rays.push_back({group.point(from), normalize(group.vector(edge - from))});
    }
    lab.rays(rays);
    lab.experiment.trace.min_power = 1e-2;
    std::vector<MeshSpec> const meshes{{"block", mesh_of(box_soup(dvec3(-0.1), dvec3(0.1))), glass, group}};
    Traced const traced = trace(with_meshes(build_scene(lab.experiment), meshes), lab.experiment.trace, 0);
    CHECK(traced.ended(Event::leak) == 0);
    CHECK(traced.result.tally.recovered > 10);
    CHECK(traced.result.tally.recovered < 1000); // and not at every turn
    CHECK(std::abs(traced.result.tally.remainder()) < 1e-13);
}

TEST_CASE("of light that runs in faces or edges which bodies have in common next to nothing is lost") {
    Dice dice(5);
    for (int const kind : {0, 1, 2}) { // exact blocks, meshes, two of each
        std::uint64_t leaks = 0, rays_traced = 0;
        for (int k = 0; k < 300; ++k) {
            Affine const group =
                k > 0 ? Affine{dice.rotation(), dice.in_box(dvec3(-1.0), dvec3(1.0))} : Affine{};
            Lab lab;
            std::vector<MeshSpec> meshes;
            for (int number = 0; number < 4; ++number) { // about the z axis
                dvec3 const centre(number % 2 - 0.5, number / 2 - 0.5, 0.0);
                MediumId const medium = lab.medium(1.4 + 0.1 * number);
                std::string const name = "block " + std::to_string(number);
                if (kind == 0 || (kind == 2 && number % 2 == 0))
                    lab.body(name, Box{{1.0, 1.0, 1.0}}, medium, compose(group, moved(centre)));
                else
                    meshes.push_back(
                        {name, mesh_of(box_soup(centre - 0.5, centre + 0.5, number > 1)), medium, group});
            }
            std::vector<RaySpec> rays;
            for (double const start : {-2.0, -0.3}) // outside, and in the face
                for (int i = 0; i < 10; ++i) {
                    dvec3 const from =
                        i == 0 ? dvec3(0.0, 0.0, start) : dvec3(0.0, dice.uniform() - 0.5, start);
                    dvec3 const along(0.0, i % 2 == 0 ? 0.0 : 0.6 * dice.uniform() - 0.3, 1.0);
                    rays.push_back({group.point(from), normalize(group.vector(along))});
                }
            rays_traced += rays.size();
            lab.rays(std::move(rays));
            lab.experiment.trace.min_power = 1e-3;
            Traced const traced =
                trace(with_meshes(build_scene(lab.experiment), meshes), lab.experiment.trace);
            leaks += traced.ended(Event::leak);
        }
        CAPTURE(kind, rays_traced, leaks);
        CHECK(500 * leaks <= rays_traced);
    }
}

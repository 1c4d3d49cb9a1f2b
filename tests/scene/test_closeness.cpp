// What is said of bodies that touch, overlap or nearly touch.
#include "scene/closeness.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"
#include "support/lathe.h"
#include "torture/solids.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

bool tells(std::vector<std::string> const& lines, std::vector<std::string> const& words) {
    return std::any_of(lines.begin(), lines.end(), [&](std::string const& line) {
        return std::all_of(words.begin(), words.end(),
                           [&](std::string const& word) { return line.find(word) != std::string::npos; });
    });
}

constexpr double wavelength = 587.6e-9;

/// Two plates of 0.1 m with a gap between them, one of them a mesh where asked for, at any angle.
Scene two_plates(double gap, bool mesh, Affine const& frame = {}, int priority = 0) {
    Lab lab;
    MediumId const one = lab.medium(1.5), two = lab.medium(1.6);
    lab.body("low", Box{{0.1, 0.1, 0.01}}, one, compose(frame, moved({0.0, 0.0, -0.005})));
    Affine const lifted = compose(frame, moved({0.0, 0.0, gap}));
    if (!mesh)
        lab.body("high", Box{{0.08, 0.1, 0.01}}, two, compose(lifted, moved({0.0, 0.0, 0.005})), priority);
    Scene scene = build_scene(lab.experiment);
    if (!mesh)
        return scene;
    auto const block =
        std::make_shared<Mesh const>(make_mesh(box_soup({-0.04, -0.05, 0.0}, {0.04, 0.05, 0.01})));
    return with_meshes(std::move(scene), {{"high", block, two, lifted, priority}});
}

} // namespace

TEST_CASE("a gap below a wavelength is told with its place, a contact or a wider gap is not") {
    Dice dice(1);
    for (bool mesh : {false, true})
        for (int k = 0; k < 6; ++k) {
            Affine const frame = k ? Affine{dice.rotation(), dice.direction()} : Affine{};
            CAPTURE(mesh, k);
            auto const warnings = near_warnings(two_plates(3e-7, mesh, frame), wavelength);
            REQUIRE(warnings.size() == 1);
            CHECK(tells(warnings, {"low.front", mesh ? "high.surface" : "high.back", "0.3 µm"}));
            CHECK(near_warnings(two_plates(0.0, mesh, frame), wavelength).empty());
            CHECK(near_warnings(two_plates(1e-6, mesh, frame), wavelength).empty());
            CHECK(tells(contact_lines(two_plates(0.0, mesh, frame)), {"low.front", "touches", "high"}));
        }
}

TEST_CASE("where a lens nearly touches a plate is found though it is a point") {
    Lab lab;
    lab.body("plate", Box{{0.1, 0.1, 0.01}}, lab.medium(1.5), moved({0.0, 0.0, -0.005}));
    lab.body("lens", Lens{0.05, -0.05, 0.004, 0.02}, lab.medium(1.6), moved({0.01, 0.002, 2e-7}));
    auto const warnings = near_warnings(build_scene(lab.experiment), wavelength);
    REQUIRE(warnings.size() == 1);
    CHECK(tells(warnings, {"plate.front", "lens.front", "0.2 µm"}));
}

namespace {

/// A doublet whose halves follow each other with different facets, or one of them exact; a spherical beam
/// goes through.
struct FacetedDoublet {
    Scene scene;
    TraceOptions options;
};

FacetedDoublet faceted_doublet(bool exact, std::uint32_t around, Affine const& frame, int priority) {
    Lab lab;
    MediumId const crown = lab.medium(1.5168), flint = lab.medium(1.67271);
    double const r1 = 61.47e-3, r2 = -44.64e-3, r3 = -129.94e-3, rim = 12.5e-3;
    if (exact)
        lab.body("crown", Lens{r1, r2, 6e-3, 2.0 * rim}, crown, frame, priority);
    std::vector<RaySpec> rays;
    Dice dice(7);
    for (int k = 0; k < 300; ++k)
        rays.push_back({frame.point(dvec3(dice.between(-8e-3, 8e-3), dice.between(-8e-3, 8e-3), -0.02)),
                        frame.vector(normalize(dvec3(0.0, 0.0, 1.0) + 0.1 * dice.direction()))});
    lab.rays(rays);
    lab.experiment.trace.min_power = 1e-4;
    std::vector<MeshSpec> meshes;
    if (!exact)
        meshes.push_back(
            {"crown", mesh_of(lens_soup(r1, r2, 0.0, 6e-3, rim, 9, 20)), crown, frame, priority});
    meshes.push_back(
        {"flint", mesh_of(lens_soup(r2, r3, 6e-3, 2.5e-3, rim, exact ? 10 : 9, around)), flint, frame});
    return {with_meshes(build_scene(lab.experiment), meshes), lab.experiment.trace};
}

} // namespace

TEST_CASE("where facets follow a curved face without lying on it that is said, and no watt is lost") {
    Dice dice(2);
    for (bool const exact : {true, false})
        for (int k = 0; k < 4; ++k) {
            Affine const frame = k ? Affine{dice.rotation(), dice.direction()} : Affine{};
            CAPTURE(exact, k);
            FacetedDoublet made = faceted_doublet(exact, 24, frame, k % 2);
            auto const warnings = near_warnings(made.scene, wavelength);
            REQUIRE(warnings.size() == 1);
            CHECK(tells(warnings, {"crown", "flint", "follow each other", "gaps and overlaps", "µm"}));
            Traced const traced = trace(std::move(made.scene), made.options);
            Tally const& tally = traced.result.tally;
            CHECK(traced.ended(Event::leak) + traced.ended(Event::invalid) == 0);
            CHECK(tally.error == ExactSum{});
            CHECK(std::abs(tally.remainder()) <= 1e-12 * tally.emitted.value(tally.unit));
        }
    // the same triangles on both sides touch
    CHECK(near_warnings(faceted_doublet(false, 20, {}, 0).scene, wavelength).empty());
}

TEST_CASE("bodies that overlap at equal priority are warned of, others are not") {
    for (bool mesh : {false, true}) {
        CAPTURE(mesh);
        CHECK(overlap_warnings(two_plates(0.0, mesh)).empty());
        CHECK(overlap_warnings(two_plates(1e-6, mesh)).empty());
        CHECK(overlap_warnings(two_plates(-1e-3, mesh, {}, 1)).empty());
        auto const warnings = overlap_warnings(two_plates(-1e-3, mesh));
        REQUIRE(warnings.size() == 1);
        CHECK(tells(warnings, {"low and high overlap", "high, the later", "mm"}));
    }
    Lab alike;
    MediumId const glass = alike.medium(1.5);
    alike.body("one", Sphere{0.1}, glass);
    alike.body("two", Sphere{0.1}, glass, moved({0.1, 0.0, 0.0}));
    CHECK(overlap_warnings(build_scene(alike.experiment)).empty());
}

// What is said of bodies that touch, overlap or nearly touch.
#include "scene/closeness.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"
#include "support/lathe.h"

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

// Which cones and quadrics lie on which curved faces of other shapes.
#include "geometry/bvh.h"
#include "support/catch.h"
#include "support/dice.h"

#include <array>

using namespace sahl;
using namespace sahl::bench;

namespace {

std::size_t contacts(std::vector<std::pair<Shape, Affine>> const& shapes) {
    std::vector<PlacedGeometry> geometries;
    std::uint32_t face = 0, shell = 0;
    for (auto const& [shape, place] : shapes) {
        geometries.push_back({shape, place, {face}, {shell}});
        face += static_cast<std::uint32_t>(face_names(shape).size());
        shell += !is_open(shape);
    }
    return Bvh(std::move(geometries)).contacts().size();
}

/// x² + y² + z² − r², and the like.
Shape quadric(std::array<double, 10> const& coefficients, dvec3 const& clip) {
    return QuadricBody{coefficients, clip};
}

} // namespace

TEST_CASE("cones and quadrics touch what lies on the same surface, in whatever frame, and nothing else",
          "[geometry]") {
    Dice dice(4);
    for (int k = 0; k < 20; ++k) {
        Affine const group = k ? Affine{dice.rotation(), dice.in_box(dvec3(-2.0), dvec3(2.0))} : Affine{};
        auto const at = [&](dvec3 const& offset) { return compose(group, Affine{dmat3(1.0), offset}); };
        double const f = 1.0 + 1e-9; // nanometres off: a gap
        CAPTURE(k);
        // a plug in a bore: cones of one side, the plug shorter
        Cone const bore{0.02, 0.01, 0.04}, plug{0.0175, 0.0125, 0.02}, loose{0.0175, 0.0125 * f, 0.02};
        CHECK(contacts({{bore, at(dvec3(0.0))}, {plug, at(dvec3(0.0))}}) == 1);
        CHECK(contacts({{bore, at(dvec3(0.0))}, {loose, at(dvec3(0.0))}}) == 0);
        CHECK(contacts({{bore, at(dvec3(0.0))}, {plug, at({0.0, 0.0, 1e-9})}}) == 0);
        // the frustum on top of it goes on in the same cone, and lies on its end: side to side, end to end
        CHECK(contacts({{bore, at(dvec3(0.0))}, {Cone{0.01, 0.005, 0.02}, at({0.0, 0.0, 0.03})}}) == 2);
        // a quadric that is a sphere, a tube, a paraboloid; and one that is none of them
        double const r = 0.03, c = 0.05;
        Shape const ball = quadric({1, 1, 1, 0, 0, 0, 0, 0, 0, -r * r}, dvec3(0.1));
        CHECK(contacts({{ball, at(dvec3(0.0))}, {Sphere{r}, at(dvec3(0.0))}}) == 1);
        CHECK(contacts({{ball, at(dvec3(0.0))}, {Sphere{r * f}, at(dvec3(0.0))}}) == 0);
        CHECK(contacts({{ball, at(dvec3(0.0))}, {Sphere{r}, at({1e-10, 0.0, 0.0})}}) == 0);
        Shape const tube = quadric({1, 1, 0, 0, 0, 0, 0, 0, 0, -r * r}, dvec3(0.1));
        CHECK(contacts({{tube, at(dvec3(0.0))}, {Cylinder{r, 0.05}, at(dvec3(0.0))}}) == 1);
        CHECK(contacts({{tube, at(dvec3(0.0))}, {Cylinder{r * f, 0.05}, at(dvec3(0.0))}}) == 0);
        Shape const dish = quadric({1, 1, 0, 0, 0, 0, 0, 0, -2.0 * c, 0}, dvec3(0.05));
        CHECK(contacts({{dish, at(dvec3(0.0))}, {ConicMirror{c, -1.0, 0.02}, at(dvec3(0.0))}}) == 1);
        CHECK(contacts({{dish, at(dvec3(0.0))}, {ConicMirror{c * f, -1.0, 0.02}, at(dvec3(0.0))}}) == 0);
        CHECK(contacts({{dish, at(dvec3(0.0))}, {ConicMirror{c, -1.0 + 1e-6, 0.02}, at(dvec3(0.0))}}) == 0);
        // caps: six planes of one face
        CHECK(contacts({{tube, at(dvec3(0.0))}, {Box{{0.2, 0.2, 0.02}}, at({0.0, 0.0, 0.06})}}) == 1);
        CHECK(contacts({{tube, at(dvec3(0.0))}, {Box{{0.2, 0.2, 0.02}}, at({0.0, 0.0, 0.06 + 1e-12})}}) == 0);
        // an ellipsoid: a stretched ball, and by its coefficients
        Affine const stretch{dmat3({1, 0, 0}, {0, 1, 0}, {0, 0, 2}), dvec3(0.0)};
        Shape const egg = quadric({1, 1, 0.25, 0, 0, 0, 0, 0, 0, -r * r}, dvec3(0.2));
        CHECK(contacts({{egg, group}, {Sphere{r}, compose(group, stretch)}}) == 1);
        CHECK(contacts({{egg, group}, {Sphere{r * f}, compose(group, stretch)}}) == 0);
    }
}

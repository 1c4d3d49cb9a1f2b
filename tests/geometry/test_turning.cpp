// How fast a face's normal turns from place to place, against the curvatures of the textbook.
#include "geometry/bvh.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/meshes.h"

#include <algorithm>
#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

std::vector<PlacedGeometry> placed(std::vector<std::pair<Shape, Affine>> const& shapes) {
    std::vector<PlacedGeometry> geometries;
    std::uint32_t face = 0, shell = 0;
    for (auto const& [shape, place] : shapes) {
        geometries.push_back({shape, place, {face}, {shell}});
        face += static_cast<std::uint32_t>(face_names(shape).size());
        shell += !is_open(shape);
    }
    return geometries;
}

dmat3 outer(dvec3 const& a) {
    return glm::outerProduct(a, a);
}

double size_of(dmat3 const& m) {
    return length(m[0]) + length(m[1]) + length(m[2]);
}

} // namespace

TEST_CASE("normals turn by the curvature of the surface, wherever it stands", "[geometry]") {
    Dice dice(3);
    for (int k = 0; k < 50; ++k) {
        Affine const place{dice.rotation(), dice.in_box(dvec3(-3.0), dvec3(3.0))};
        double const radius = dice.log_between(1e-3, 10.0);
        dvec3 const z = place.vector({0.0, 0.0, 1.0});
        SECTION("sphere " + std::to_string(k)) {
            Bvh const bvh(placed({{Sphere{radius}, place}}));
            dvec3 const n = dice.direction();
            dmat3 const expected = (1.0 / radius) * (dmat3(1.0) - outer(n));
            CHECK(size_of(bvh.turning(0, {0}, -1, place.offset + radius * n, n) - expected) < 1e-8 / radius);
            CHECK(size_of(bvh.turning(0, {0}, -1, place.offset + radius * n, -n) + expected) < 1e-8 / radius);
        }
        SECTION("cylinder " + std::to_string(k)) {
            Bvh const bvh(placed({{Cylinder{radius, 2.0 * radius}, place}}));
            dvec3 const n = perpendicular_to(z, dice.direction());
            CHECK(size_of(bvh.turning(0, {0}, -1, place.offset + radius * n, n) -
                          (1.0 / radius) * (dmat3(1.0) - outer(n) - outer(z))) < 1e-8 / radius);
            CHECK(bvh.turning(0, {2}, -1, place.offset + radius * z, z) == dmat3(0.0));
        }
        SECTION("paraboloid " + std::to_string(k)) {
            // z = r²/2R: across the meridian 1/(R √(1 + s²)), along it 1/(R (1 + s²)^1.5), s = r/R the slope
            double const s = dice.between(0.1, 0.5), r = s * radius, w = std::sqrt(1.0 + s * s);
            Bvh const bvh(placed({{ConicMirror{radius, -1.0, 2.0 * radius}, place}}));
            dvec3 const x = place.vector({1.0, 0.0, 0.0}), y = place.vector({0.0, 1.0, 0.0});
            dvec3 const at = place.point({r, 0.0, 0.5 * r * s}), n = (z - s * x) / w, along = (x + s * z) / w;
            dmat3 const expected =
                (-1.0 / radius) * ((1.0 / w) * outer(y) + (1.0 / (w * w * w)) * outer(along));
            CHECK(size_of(bvh.turning(0, {0}, -1, at, n) - expected) < 1e-7 / radius);
        }
        SECTION("a ball as a mesh with its own normals " + std::to_string(k)) {
            TriangleSoup soup = ball_soup(radius, 3);
            soup.normals.clear();
            for (dvec3 const& p : soup.positions)
                soup.normals.push_back(normalize(p));
            auto const mesh = std::make_shared<Mesh const>(make_mesh(std::move(soup)));
            std::vector<PlacedGeometry> geometries(1);
            geometries[0].geometry = mesh;
            geometries[0].to_world = place;
            auto const triangle = static_cast<std::uint32_t>(dice.below(mesh->soup.triangles.size()));
            auto const& [a, b, c] = mesh->soup.triangles[triangle];
            dvec3 const middle =
                (mesh->soup.positions[a] + mesh->soup.positions[b] + mesh->soup.positions[c]) / 3.0;
            dvec3 const n = place.vector(normalize(middle));
            CHECK(Bvh(geometries).turning(0, {0}, std::int32_t(triangle), place.point(middle), n) ==
                  dmat3(0.0));
            geometries[0].interpolate = true;
            dmat3 const turning =
                Bvh(geometries).turning(0, {0}, std::int32_t(triangle), place.point(middle), n);
            // the triangles' sag is some hundredth of the radius
            CHECK(size_of(turning - (1.0 / radius) * (dmat3(1.0) - outer(n))) < 0.05 / radius);
        }
    }
}

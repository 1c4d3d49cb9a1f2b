// What meshes are recognised as, judged by the exact shapes that they were made of.
#include "geometry/recognise.h"

#include "geometry/tessellate.h"
#include "math/random.h"
#include "support/catch.h"
#include "support/curved.h"

#include <cmath>
#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// Turned out of every axis and rounded to float.
std::shared_ptr<Mesh const> as_mesh(Shape const& shape, unsigned pieces, dmat3 const& turn) {
    TriangleSoup soup = tessellate(shape, pieces).soup;
    for (dvec3& p : soup.positions)
        p = as_float(turn * p);
    for (dvec3& n : soup.normals)
        n = normalize(as_float(turn * n));
    return std::make_shared<Mesh const>(make_mesh(std::move(soup)));
}

dmat3 slanted() {
    dvec3 const z = normalize(dvec3(0.3, -0.5, 0.8)), x = perpendicular_to(z);
    return {x, cross(z, x), z};
}

/// Greatest angle between the normals of both where lines from within leave them, and share of the size that
/// these places are apart.
struct Apart {
    double angle = 0.0, place = 0.0;
};
Apart apart(Solid const& one, Solid const& other, dmat3 const& turn, dvec3 const& inside, double size) {
    Apart worst;
    for (std::uint64_t i = 0; i < 500; ++i) {
        double const z = 2.0 * uniform(4, i, 0, 0) - 1.0,
                     around = 2.0 * std::numbers::pi * uniform(4, i, 0, 1);
        dvec3 const along(std::sqrt(1.0 - z * z) * std::cos(around),
                          std::sqrt(1.0 - z * z) * std::sin(around), z);
        auto const a = one.next(inside, along, true, 0.0, 0.0),
                   b = other.next(turn * inside, turn * along, true, 0.0, 0.0);
        REQUIRE(a);
        REQUIRE(b);
        dvec3 p = inside + a->t * along, q = turn * (inside + b->t * along);
        dvec3 const n = turn * one.settle(a->face, p), m = other.settle(b->face, q);
        if (std::abs(a->t - b->t) > 1e-3 * size) // one leaves just before an edge, the other behind it
            continue;
        worst.place = std::max(worst.place, std::abs(a->t - b->t) / size);
        if (dot(n, m) > 0.99)
            worst.angle = std::max(worst.angle, length(cross(n, m)));
    }
    return worst;
}

} // namespace

TEST_CASE("lenses, rods, cones and conics of revolution are recognised, in any place", "[curved]") {
    struct Known {
        char const* name;
        Shape shape;
        dvec3 inside;
    };
    std::vector<Known> const all{
        {"biconvex", Lens{0.05, -0.05, 0.01, 0.03}, {0.0, 0.0, 5e-3}},
        {"meniscus", Lens{0.02, 0.035, 0.004, 0.02}, {0.0, 0.0, 2e-3}},
        {"rod", Cylinder{0.004, 0.02}, {1e-4, 0.0, 0.0}},
        {"cone", Cone{0.006, 0.003, 0.012}, {1e-4, 0.0, 0.0}},
        {"paraboloid lens", Lens{0.02, 0.0, 0.008, 0.02, -1.0}, {1e-4, 0.0, 4e-3}},
        {"hyperboloid lens", Lens{0.02, -0.03, 0.008, 0.02, -2.3, -1.7}, {1e-4, 0.0, 4e-3}},
        {"ellipsoid lens", Lens{0.02, 0.0, 0.008, 0.02, 0.6}, {1e-4, 0.0, 4e-3}},
        {"hollow conics", Lens{-0.03, 0.025, 0.004, 0.016, -0.8, 0.3}, {0.0, 0.0, 2e-3}},
    };
    for (Known const& known : all) {
        INFO(known.name);
        SmoothFans const fans = smooth_fans(as_mesh(known.shape, 72, slanted()));
        auto const found = recognise(fans);
        REQUIRE(found);
        Apart const off = apart(Solid(known.shape), found->solid, slanted(), known.inside, 0.01);
        INFO(off.angle << " rad, " << off.place);
        CHECK(off.angle < 1e-7); // the worst, at the rim; what floats of so many places allow
        CHECK(off.place < 1e-7);
        for (unsigned way = 0; way < ways_to_halve; ++way)
            for (bool const rest : {false, true})
                CHECK(recognise(fans, {way, rest}));
    }
}

TEST_CASE("what is no conic of revolution is not recognised", "[curved]") {
    Lens asphere{0.02, 0.0, 0.008, 0.02};
    asphere.aspheric1 = {200.0}; // m⁻³: 2 µm at the rim, of which a conic can follow all but some 50 nm
    CHECK(!recognise(smooth_fans(as_mesh(asphere, 72, slanted()))));
    TriangleSoup ellipsoid = geodesic_soup(1.0, 12);
    for (dvec3& p : ellipsoid.positions)
        p *= dvec3(5e-3, 4e-3, 6e-3);
    CHECK(!recognise(smooth_fans(
        float_mesh(ellipsoid, [](dvec3 const& p) { return normalize(p / dvec3(25.0, 16.0, 36.0)); }))));
}

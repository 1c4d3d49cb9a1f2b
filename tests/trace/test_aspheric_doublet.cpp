// Lenses cemented along aspheric and conic faces: one boundary, in whatever frame, against a sequential trace
// in long double that knows each surface's equation and nothing else.
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"

#include <array>
#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

using Long = long double;

struct Surface {
    double vertex, radius, conic;
    std::vector<double> terms;

    Long sag(Long r2) const {
        Long const c = 1 / Long(radius);
        Long z = c * r2 / (1 + std::sqrt(1 - (1 + conic) * c * c * r2)), power = r2;
        for (double const term : terms)
            z += term * (power *= r2);
        return vertex + z;
    }
    Long slope_over_r(Long r2) const { // dz/dr / r
        Long const c = 1 / Long(radius);
        Long s = c / std::sqrt(1 - (1 + conic) * c * c * r2), power = 1;
        Long k = 4;
        for (double const term : terms) {
            s += k * term * (power *= r2);
            k += 2;
        }
        return s;
    }
};

struct Path {
    Long p[3], d[3];
    void through(Surface const& surface, Long before, Long after) {
        Long t = (surface.vertex - p[2]) / d[2];
        for (int pass = 0; pass < 60; ++pass) {
            Long const x = p[0] + t * d[0], y = p[1] + t * d[1], r2 = x * x + y * y,
                       s = surface.slope_over_r(r2);
            t -= (p[2] + t * d[2] - surface.sag(r2)) / (d[2] - s * (x * d[0] + y * d[1]));
        }
        for (int i = 0; i < 3; ++i)
            p[i] += t * d[i];
        Long const s = surface.slope_over_r(p[0] * p[0] + p[1] * p[1]);
        Long n[3] = {s * p[0], s * p[1], -1}; // against the light
        Long const size = std::sqrt(n[0] * n[0] + n[1] * n[1] + 1);
        Long along = 0;
        for (int i = 0; i < 3; ++i)
            along += d[i] * (n[i] /= size);
        Long const ratio = before / after,
                   factor = -ratio * along - std::sqrt(1 - ratio * ratio * (1 - along * along));
        for (int i = 0; i < 3; ++i)
            d[i] = ratio * d[i] + factor * n[i];
    }
};

struct Doublet {
    char const* name;
    Surface front, middle, back;
    std::size_t contacts; // of faces: the cemented ones, and the edges on one cylinder
};

std::vector<Doublet> doublets() {
    return {{"a conic face", {0.0, 60e-3, 0.0, {}}, {6e-3, -45e-3, -1.7, {}}, {9e-3, -130e-3, 0.0, {}}, 2},
            {"an aspheric face",
             {0.0, 60e-3, -0.6, {-10.0}},
             {6e-3, -45e-3, 0.3, {60.0, -2e4, 1e7}},
             {9e-3, -130e-3, 0.0, {5.0}},
             2},
            {"a paraboloid", {0.0, 50e-3, 0.0, {}}, {6e-3, 80e-3, -1.0, {}}, {9e-3, -90e-3, -1.0, {}}, 2}};
}

Lab lab_of(Doublet const& doublet, Affine const& frame, double gap) {
    Lab lab;
    auto const& [name, a, b, c, contacts] = doublet;
    lab.body("crown", Lens{a.radius, b.radius, b.vertex, 24e-3, a.conic, b.conic, a.terms, b.terms},
             lab.medium(1.5), frame);
    lab.body("flint",
             Lens{b.radius, c.radius, c.vertex - b.vertex, 24e-3, b.conic, c.conic, b.terms, c.terms},
             lab.medium(1.7), compose(frame, moved({0.0, 0.0, b.vertex + gap})));
    return lab;
}

} // namespace

TEST_CASE("lenses cemented along a conic or aspheric face are one boundary in any frame, as a sequential "
          "trace says",
          "[trace]") {
    Dice dice(11);
    for (Doublet const& doublet : doublets())
        for (int k = 0; k < 12; ++k) {
            Affine const frame = k ? Affine{dice.rotation(), double(k % 3) * dice.direction()} : Affine{};
            CAPTURE(doublet.name, k);
            Lab lab = lab_of(doublet, frame, 0.0);
            std::vector<RaySpec> rays;
            std::vector<Path> expected;
            for (int ray = 0; ray < 100; ++ray) {
                dvec3 const at(dice.between(-7e-3, 7e-3), dice.between(-7e-3, 7e-3), 0.0),
                    d = normalize(dvec3(0.0, 0.0, 1.0) + 0.15 * dice.direction()), from = at - 0.02 * d;
                rays.push_back({frame.point(from), frame.vector(d)});
                Path path{{from.x, from.y, from.z}, {d.x, d.y, d.z}};
                path.through(doublet.front, 1.0L, 1.5L);
                path.through(doublet.middle, 1.5L, 1.7L);
                path.through(doublet.back, 1.7L, 1.0L);
                expected.push_back(path);
            }
            lab.rays(rays);
            lab.experiment.trace.branch = BranchPolicy::split;
            lab.experiment.trace.min_power = 0.5;
            Scene scene = build_scene(lab.experiment);
            CHECK(scene.bvh->contacts().size() == doublet.contacts);
            Traced const traced = trace(std::move(scene), lab.experiment.trace);
            CHECK(traced.ended(Event::leak) + traced.ended(Event::invalid) == 0);
            std::size_t arrived = 0;
            for (Segment const& segment : traced.segments()) {
                if (segment.ended != Event::escaped)
                    continue;
                ++arrived;
                REQUIRE(segment.depth == 3); // and not four: no film between
                Path const& path = expected[segment.ray];
                dvec3 const place(double(path.p[0]), double(path.p[1]), double(path.p[2])),
                    direction(double(path.d[0]), double(path.d[1]), double(path.d[2]));
                REQUIRE(length(segment.origin - frame.point(place)) < 1e-14 * (1.0 + length(frame.offset)));
                REQUIRE(length(segment.direction - frame.vector(direction)) < 1e-12);
            }
            CHECK(arrived == rays.size());
        }
}

TEST_CASE("a picometre between conic or aspheric faces is a gap", "[trace]") {
    Dice dice(12);
    for (Doublet const& doublet : doublets())
        for (int k = 0; k < 6; ++k) {
            Affine const frame = k ? Affine{dice.rotation(), 0.2 * dice.direction()} : Affine{};
            CAPTURE(doublet.name, k);
            Lab lab = lab_of(doublet, frame, 1e-12);
            lab.rays({{frame.point({1e-3, 2e-3, -0.02}), frame.vector({0.0, 0.0, 1.0})}});
            lab.experiment.trace.min_power = 0.5;
            Scene scene = build_scene(lab.experiment);
            CHECK(scene.bvh->contacts().size() == 1); // the edges
            Traced const traced = trace(std::move(scene), lab.experiment.trace);
            for (Segment const& segment : traced.segments())
                if (segment.ended == Event::escaped)
                    CHECK(segment.depth == 4);
        }
}

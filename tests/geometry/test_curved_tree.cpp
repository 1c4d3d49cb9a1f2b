// A ball as triangles carry it, met as the ball that it stands for: judged by the sphere itself.
#include "geometry/curved_tree.h"

#include "math/random.h"
#include "support/catch.h"
#include "support/curved.h"

#include <cmath>
#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr double radius = 5e-3;    // m
constexpr double rounding = 1e-17; // m
constexpr std::uint32_t fine = 28; // 15 680 triangles

ShellSet in_ball() {
    ShellSet set;
    set.insert({0});
    return set;
}

CurvedAnswer next(CurvedTree const& tree, dvec3 const& origin, dvec3 const& direction, ShellSet const& set) {
    return tree.next(origin, direction, {set, {0}}, {0.0, INFINITY}, rounding);
}

dvec3 any_direction(std::uint64_t ray, std::uint64_t place) {
    double const z = 2.0 * uniform(7, ray, place, 0) - 1.0,
                 turn = 2.0 * std::numbers::pi * uniform(7, ray, place, 1);
    double const r = std::sqrt(1.0 - z * z);
    return {r * std::cos(turn), r * std::sin(turn), z};
}

/// RMS over rays that come from everywhere: angle between normals and the sphere's, share of the radius that
/// points lie off it.
struct Errors {
    double normal = 0.0, place = 0.0;
};
Errors errors_of(PatchKind kind, std::shared_ptr<Mesh const> const& ball) {
    CurvedTree const tree(ball, kind);
    Errors sum;
    constexpr std::uint64_t rays = 4000;
    for (std::uint64_t i = 0; i < rays; ++i) {
        dvec3 const from = 3.0 * radius * any_direction(i, 0), to = 0.8 * radius * any_direction(i, 1);
        auto const answer = next(tree, from, normalize(to - from), {});
        REQUIRE(answer.crossing);
        dvec3 const off = cross(answer.crossing->normal, normalize(answer.crossing->point));
        double const away = length(answer.crossing->point) / radius - 1.0;
        sum.normal += dot(off, off) / rays;
        sum.place += away * away / rays;
    }
    return {std::sqrt(sum.normal), std::sqrt(sum.place)};
}

double order(double coarse, double fine_error, double ratio) {
    return std::log(coarse / fine_error) / std::log(ratio);
}

} // namespace

TEST_CASE("fitted patches converge with the fourth order or better", "[curved]") {
    for (bool const floats : {false, true}) {
        auto const error = [&](std::uint32_t frequency) {
            return errors_of(PatchKind::fitted,
                             floats ? float_ball(radius, frequency) : double_ball(radius, frequency))
                .normal;
        };
        double const coarse = error(4), finer = error(8), finest = error(16);
        WARN("normals of a fitted ball of 320, 1 280, 5 120 triangles, in "
             << (floats ? "float" : "double") << ": RMS " << coarse << ", " << finer << ", " << finest
             << " rad");
        // of the last, floats leave as much open as the fit
        CHECK(order(coarse, floats ? finest : finer, floats ? 4.0 : 2.0) > 3.7);
        if (!floats)
            CHECK(order(finer, finest, 2.0) > 4.5);
    }
}

TEST_CASE("quadratic patches converge with the third order or better", "[curved]") {
    double const coarse = errors_of(PatchKind::quadratic, float_ball(radius, 4)).place,
                 finer = errors_of(PatchKind::quadratic, float_ball(radius, 8)).place;
    WARN("a quadratic ball of 320, 1 280 triangles lies off by RMS " << coarse << ", " << finer << " R");
    CHECK(order(coarse, finer, 2.0) > 2.7);
}

TEST_CASE("a fitted ball's normals are those of the sphere to 3e-8 rad", "[curved]") {
    Errors const errors = errors_of(PatchKind::fitted, float_ball(radius, fine));
    WARN("normals of a fitted ball of 15 680 triangles: RMS " << errors.normal << " rad, places "
                                                              << errors.place << " R");
    CHECK(errors.normal < 3e-8); // what float normals say, averaged over a patch
}

TEST_CASE(
    "no silhouette ray up to 0.999 of a curved ball's radius misses it, none beyond its rounding meets it",
    "[curved]") {
    for (PatchKind const kind : {PatchKind::quadratic, PatchKind::fitted}) {
        CurvedTree const tree(float_ball(radius, fine), kind);
        std::uint64_t missed = 0, met = 0;
        for (std::uint64_t i = 0; i < 20000; ++i) {
            dvec3 const along = any_direction(i, 0), side = perpendicular_to(along, any_direction(i, 1));
            double const share = i % 2 ? 0.99 + 0.00999 * uniform(7, i, 2, 0) : 1.00001;
            auto const answer = next(tree, -0.02 * along + share * radius * side, along, {});
            missed += i % 2 && !answer.crossing;
            met += i % 2 == 0 && answer.crossing;
        }
        CHECK(missed == 0);
        CHECK(met == 0);
    }
}

TEST_CASE("light in a whispering gallery never leaks out of a curved ball", "[curved]") {
    for (PatchKind const kind : {PatchKind::quadratic, PatchKind::fitted}) {
        CurvedTree const tree(float_ball(radius, fine), kind);
        std::uint64_t leaks = 0, wrong = 0, recovered = 0;
        for (std::uint64_t walk = 0; walk < 40; ++walk) {
            dvec3 const out = any_direction(walk, 3);
            auto const start = next(tree, 2.0 * radius * out, -out, {});
            REQUIRE(start.crossing);
            dvec3 point = start.crossing->point;
            dvec3 const tangent = perpendicular_to(start.crossing->normal, any_direction(walk, 4));
            dvec3 direction = normalize(tangent - 3e-3 * start.crossing->normal);
            for (int bounce = 0; bounce < 500; ++bounce) {
                auto const answer = next(tree, point, direction, in_ball());
                if (!answer.crossing) {
                    ++leaks;
                    break;
                }
                recovered += answer.crossing->recovered;
                wrong += std::abs(length(answer.crossing->point) / radius - 1.0) > 1e-6;
                point = answer.crossing->point;
                dvec3 const& n = answer.crossing->normal;
                direction = normalize(direction - 2.0 * dot(direction, n) * n);
            }
        }
        CHECK(leaks == 0);
        CHECK(wrong == 0);
        WARN("recovered: " << recovered);
    }
}

TEST_CASE("a ray inside a curved ball knows it, wherever it starts", "[curved]") {
    CurvedTree const tree(float_ball(radius, fine), PatchKind::fitted);
    for (std::uint64_t i = 0; i < 2000; ++i) {
        double const share = i % 2 ? 0.99999 : 1.00001; // both lie between the facets and the sphere, or near
        CHECK(tree.inside(share * radius * any_direction(i, 0), any_direction(i, 1), rounding).front() ==
              (i % 2 == 1));
    }
}

TEST_CASE("a box stays a box, whatever patches its triangles carry", "[curved]") {
    auto const box = std::make_shared<Mesh const>(make_mesh(box_soup({-1.0, -2.0, -3.0}, {1.0, 2.0, 3.0})));
    for (PatchKind const kind : {PatchKind::quadratic, PatchKind::fitted}) {
        CurvedTree const tree(box, kind);
        for (std::uint64_t i = 0; i < 2000; ++i) {
            dvec3 const along = any_direction(i, 0);
            auto const answer = next(tree, dvec3(0.1, 0.2, 0.3), along, in_ball());
            REQUIRE(answer.crossing);
            dvec3 const p = glm::abs(answer.crossing->point) - dvec3(1.0, 2.0, 3.0);
            CHECK(std::abs(std::max({p.x, p.y, p.z})) < 1e-15);
            dvec3 const n = glm::abs(answer.crossing->normal);
            CHECK(std::max({n.x, n.y, n.z}) > 1.0 - 1e-15);
        }
    }
}

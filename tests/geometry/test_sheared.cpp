// Shapes under transforms that turn, stretch unequally, shear and mirror: a ray goes in, a normal comes back.
// Judges: the shapes by their definition in words, in their own frame; the normal by differences of it.
#include "geometry/bvh.h"
#include "geometry/revolved.h"
#include "geometry/shape_oracle.h"
#include "support/catch.h"

#include <cmath>
#include <optional>

using namespace sahl;
using namespace sahl::bench;

namespace {

std::vector<Affine> transforms() {
    return {{dmat3(1.0, 0.0, 0.0, 0.4, 1.0, 0.0, -0.3, 0.2, 1.0), {0.1, -0.2, 0.3}},   // shear
            {dmat3(2.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 1.3), {3.0, 0.0, -1.0}},    // unequal scale
            {dmat3(0.0, 1.2, 0.3, -0.8, 0.1, 0.0, 0.2, 0.0, -0.9), {-1.0, 2.0, 5.0}}}; // all, mirrored
}

/// Towards larger depth, in the shape's own frame; nothing where two faces are near.
template <class Depth>
std::optional<dvec3> inwards(Depth depth, dvec3 const& p) {
    constexpr double step = 1e-5;
    dvec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 ahead = p, behind = p;
        ahead[axis] += step;
        behind[axis] -= step;
        double const one = depth(ahead) - depth(p), other = depth(p) - depth(behind);
        if (std::abs(one - other) > 1e-3 * step)
            return std::nullopt;
        gradient[axis] = (one + other) / (2.0 * step);
    }
    return normalize(gradient);
}

struct Count {
    int met = 0, normals = 0, wrong = 0;
};

/// Lines through the shape: every crossing is on it, changes sides, and has its normal.
template <class Depth>
void walk(Shape const& shape, Depth depth, Affine const& to_world, dvec3 const& aim, Dice& dice,
          Count& count) {
    Bvh const bvh({{shape, to_world, {0}, {0}, false, false}});
    Affine const to_local = inverse(to_world);
    dmat3 const normals_to_world = glm::transpose(to_local.linear);
    dvec3 const target = to_world.point(aim + 0.2 * dice.direction());
    dvec3 const direction = dice.direction();
    dvec3 const origin = target - 20.0 * direction;
    ShellSet inside;
    double from = 0.0;
    for (int k = 0; k < 20; ++k) {
        NextHit const hit = bvh.next(origin, direction, inside, {}, from);
        if (hit.at_one_place.empty())
            break;
        Crossing const& c = hit.at_one_place[0];
        dvec3 const local = to_local.point(c.point);
        ++count.met;
        count.wrong += std::abs(depth(local)) > 1e-9; // the words' rounding near a rim
        count.wrong += length(c.point - (origin + c.t * direction)) > 1e-12;
        count.wrong += c.enters != (dot(c.normal, direction) < 0.0);
        count.wrong += std::abs(length(c.normal) - 1.0) > 1e-14;
        if (auto const in = inwards(depth, local)) {
            ++count.normals;
            dvec3 const expected = -normalize(normals_to_world * *in);
            count.wrong += length(cross(expected, c.normal)) > 1e-4 || dot(expected, c.normal) < 0.0;
        }
        if (c.open)
            break;
        c.enters ? (void)inside.insert(c.shell) : (void)inside.erase(c.shell);
        from = c.t;
    }
    count.wrong += !inside.empty();
}

} // namespace

TEST_CASE("sheared, stretched and mirrored bodies are met on their surface, with its normal", "[geometry]") {
    Dice dice(31);
    for (auto const& [name, shape] : closed_shapes()) {
        INFO(name);
        auto const in_words = [&body = shape](dvec3 const& p) { return depth(body, p); };
        Count count;
        for (Affine const& to_world : transforms())
            for (int k = 0; k < 300; ++k)
                walk(shape, in_words, to_world, middle(shape), dice, count);
        CHECK(count.met > 400);
        CHECK(count.normals > 300);
        CHECK(count.wrong == 0);
    }
}

TEST_CASE("sheared, stretched and mirrored conic mirrors are met on their surface, with its normal",
          "[geometry]") {
    Dice dice(32);
    for (ConicMirror const& mirror : {ConicMirror{1.0, -1.0, 1.2, 0.1}, ConicMirror{-0.8, 0.4, 1.0, 0.2},
                                      ConicMirror{0.9, -3.0, 1.4, 0.0}}) {
        Revolved const form = form_of(mirror);
        auto const below = [&](dvec3 const& p) { // > 0: on the side that −z is on
            return form.sag(std::hypot(p.x, p.y)) - p.z;
        };
        Count count;
        for (Affine const& to_world : transforms())
            for (int k = 0; k < 400; ++k)
                walk(mirror, below, to_world, {0.3, 0.0, form.sag(0.3)}, dice, count);
        CHECK(count.met > 400);
        CHECK(count.normals > 300);
        CHECK(count.wrong == 0);
    }
}

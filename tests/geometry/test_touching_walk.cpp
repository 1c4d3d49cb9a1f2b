// Long walks through layers that touch, thin or thick, meshes and exact shapes, anywhere and of any size: at
// each face the ray goes through or turns back at random, and must be where closed form says.
#include "geometry/bvh.h"
#include "optics/snell.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/meshes.h"

#include <memory>
#include <optional>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// Layers on each other along z from 0 up, each of 1 × 1, every other one a mesh.
struct Stack {
    std::vector<double> borders;
    Bvh bvh;
    Affine place;

    static Bvh assembled(std::vector<double> const& borders, Affine const& place) {
        std::vector<PlacedGeometry> geometries;
        for (std::uint32_t k = 0; k + 1 < borders.size(); ++k) {
            std::variant<Shape, std::shared_ptr<Mesh const>> geometry =
                Shape(Box{{1.0, 1.0, borders[k + 1] - borders[k]}});
            Affine to_world = compose(place, {dmat3(1.0), {0.0, 0.0, 0.5 * (borders[k] + borders[k + 1])}});
            if (k % 2) {
                geometry = std::make_shared<Mesh const>(
                    make_mesh(box_soup({-0.5, -0.5, borders[k]}, {0.5, 0.5, borders[k + 1]}, k % 4 == 1)));
                to_world = place;
            }
            geometries.push_back({geometry, to_world, {10 * k}, {k}, false, false});
        }
        return Bvh(std::move(geometries));
    }
    Stack(std::vector<double> at, Affine const& where)
        : borders(std::move(at)), bvh(assembled(borders, where)), place(where) {}

    /// Which layer holds the point; −1: none. Nothing where it is too near a border to tell.
    std::optional<int> layer_at(dvec3 const& point, double rounding) const {
        dvec3 const local = inverse(place).point(point);
        double const aside = std::max(std::abs(local.x), std::abs(local.y)) - 0.5;
        if (std::abs(aside) < rounding)
            return std::nullopt;
        for (double const border : borders)
            if (std::abs(local.z - border) < rounding)
                return std::nullopt;
        int layer = -1;
        for (std::size_t k = 0; k + 1 < borders.size(); ++k)
            if (aside < 0.0 && local.z > borders[k] && local.z < borders[k + 1])
                layer = static_cast<int>(k);
        return layer;
    }
};

struct Walk {
    int steps = 0, wrong = 0, told = 0;
};

/// Reflected at the outer faces, so that it never ends. `rounding` in the stack's own frame.
void walk(Stack const& stack, dvec3 origin, dvec3 direction, int steps, double rounding, Dice& dice,
          Walk& result) {
    Bvh::Start const start = stack.bvh.start_at(origin, direction);
    ShellSet inside = start.inside;
    for (int k = 0; k < steps; ++k) {
        NextHit const hit = stack.bvh.next(origin, direction, inside, {});
        if (hit.proof == Proof::leak || hit.at_one_place.empty()) {
            result.wrong += !inside.empty() || hit.proof == Proof::leak;
            return;
        }
        ++result.steps;
        Crossing const& first = hit.at_one_place.front();
        if (auto const layer = stack.layer_at(0.5 * (origin + first.point), rounding)) {
            ++result.told;
            bool const right = *layer < 0 ? inside.empty()
                                          : inside.contains({static_cast<std::uint32_t>(*layer)}) &&
                                                std::distance(inside.begin(), inside.end()) == 1;
            result.wrong += !right;
        }
        ShellSet after = inside;
        for (Crossing const& c : hit.at_one_place)
            if (c.enters)
                after.insert(c.shell);
            else
                after.erase(c.shell);
        origin = first.point;
        if (!after.empty() && dice.below(2)) {
            inside = after;
        } else {
            dvec3 const normal = dot(direction, first.normal) > 0.0 ? -first.normal : first.normal;
            direction = normalize(reflect(direction, normal));
        }
    }
}

Walk walks(Stack const& stack, double rounding, int rays, int steps, std::uint64_t seed) {
    Dice dice(seed);
    Walk result;
    for (int k = 0; k < rays; ++k) {
        double const border = stack.borders[dice.below(stack.borders.size())];
        dvec3 start = dice.in_box({-0.5, -0.5, stack.borders.front()}, {0.5, 0.5, stack.borders.back()});
        if (k % 3 == 0)
            start.z = border; // on a common face
        if (k % 5 == 0)
            start.y = start.x; // and on a diagonal
        dvec3 direction = dice.direction();
        if (k % 4 == 0) { // grazing
            direction.z = dice.sign() * dice.log_between(1e-6, 1e-1);
            direction = normalize(direction);
        }
        walk(stack, stack.place.point(start), normalize(stack.place.vector(direction)), steps, rounding, dice,
             result);
    }
    return result;
}

} // namespace

TEST_CASE("a ray among layers that touch is always where it should be") {
    Dice dice(1);
    std::vector<std::vector<double>> const stacks{
        {0.0, 0.3, 0.7, 1.0, 1.1}, {0.0, 0.5, 0.5 + 1e-6, 1.0}, {0.0, 1e-6, 2e-6, 3e-6, 4e-6}};
    for (std::size_t s = 0; s < stacks.size(); ++s)
        for (double scale : {1e-6, 1.0, 1e3})
            for (double offset : {0.0, 1.0, 1e3, 1e5}) {
                bool const turned = offset > 0.0;
                Affine const place{scale * (turned ? dice.rotation() : dmat3(1.0)),
                                   scale * offset * dice.direction()};
                Stack const stack(stacks[s], place);
                CAPTURE(s, scale, offset);
                CHECK(stack.bvh.contacts().size() >= stacks[s].size() - 2);
                Walk const done = walks(stack, 1e-13 * (1.0 + offset), 60, 100, 7);
                CHECK(done.wrong == 0);
                CHECK(done.steps > 3000);
                CHECK(done.told > done.steps / 2);
            }
}

TEST_CASE("nor does it lose its way in ten thousand steps", "[slow]") {
    Dice dice(2);
    for (double offset : {0.0, 1.0, 1e4}) {
        Stack const stack({0.0, 0.3, 0.3 + 1e-6, 1.0, 1.1},
                          {offset > 0.0 ? dice.rotation() : dmat3(1.0), offset * dice.direction()});
        CAPTURE(offset);
        Walk const done = walks(stack, 1e-13 * (1.0 + offset), 30, 10'000, 8);
        CHECK(done.wrong == 0);
        CHECK(done.steps > 100'000);
    }
}

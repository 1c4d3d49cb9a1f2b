// The tree of boxes: no box that a line meets is left out, near or far, large or small, whatever the line.
#include "geometry/embree/box_tree.h"
#include "support/catch.h"
#include "support/dice.h"

#include <algorithm>
#include <limits>
#include <vector>

using namespace sahl;
using namespace sahl::bench;

namespace {

struct Line {
    dvec3 origin, direction;
};

/// The plain slab test in long double: where the line is within the box.
bool meets(Bounds const& box, Line const& line, Reach reach) {
    long double from = reach.from, to = reach.to;
    for (int axis = 0; axis < 3; ++axis) {
        long double const o = line.origin[axis], d = line.direction[axis];
        if (d == 0.0L) {
            if (o < box.low[axis] || o > box.high[axis])
                return false;
            continue;
        }
        long double const one = (box.low[axis] - o) / d, other = (box.high[axis] - o) / d;
        from = std::max(from, std::min(one, other));
        to = std::min(to, std::max(one, other));
    }
    return from <= to;
}

std::vector<Bounds> scattered_boxes(Dice& dice, int count, double scale, dvec3 const& centre) {
    std::vector<Bounds> boxes;
    for (int k = 0; k < count; ++k) {
        dvec3 const at = centre + scale * dice.in_box(dvec3(-1.0), dvec3(1.0));
        dvec3 size = scale * dice.log_between(1e-9, 0.1) * dice.in_box(dvec3(0.0), dvec3(1.0));
        if (k % 3 == 0)
            size[static_cast<int>(dice.below(3))] = 0.0; // flat, as of a triangle along an axis
        boxes.push_back({at - size, at + size});
    }
    return boxes;
}

/// Boxes that are met and not visited, or visited twice.
int wrong_boxes(BoxTree const& tree, std::vector<Bounds> const& boxes, Line const& line, Reach reach) {
    std::vector<int> visits(boxes.size(), 0);
    tree.visit(line.origin, line.direction, reach, [&](std::uint32_t box, double to) {
        ++visits[box];
        return to;
    });
    int wrong = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        wrong += visits[i] > 1 || (meets(boxes[i], line, reach) && visits[i] == 0);
    return wrong;
}

} // namespace

TEST_CASE("no box that a line meets is left out, from a micrometre to a kilometre, and from afar") {
    Dice dice(1);
    for (double scale : {1e-6, 1.0, 1e3})
        for (double far : {0.0, 1e3, 1e6}) { // of the scene from the origin, in its own sizes
            dvec3 const centre = scale * far * dice.direction();
            std::vector<Bounds> const boxes = scattered_boxes(dice, 300, scale, centre);
            BoxTree const tree(boxes);
            int wrong = 0;
            for (int k = 0; k < 1000; ++k) {
                Bounds const& box = boxes[dice.below(boxes.size())];
                dvec3 const corner(dice.below(2) ? box.low.x : box.high.x,
                                   dice.below(2) ? box.low.y : box.high.y,
                                   dice.below(2) ? box.low.z : box.high.z);
                dvec3 const target =
                    k % 2 ? corner : dice.in_box(box.low, box.high); // the oracle is exact at corners
                dvec3 direction = dice.log_between(1e-3, 1e3) * dice.direction();
                if (k % 5 == 0)
                    direction = dvec3(0.0, dice.sign(), 0.0);
                double const back = scale * dice.log_between(1e-6, 1e3) / length(direction);
                wrong += wrong_boxes(tree, boxes, {target - back * direction, direction}, {0.0, INFINITY});
                wrong += wrong_boxes(tree, boxes, {target, direction}, {0.0, INFINITY});
                wrong += wrong_boxes(tree, boxes, {target, direction}, {-back, back});
            }
            CAPTURE(scale, far);
            CHECK(wrong == 0);
        }
}

TEST_CASE("a visitor that lowers the end is spared what lies far beyond, and nothing before") {
    Dice dice(2);
    std::vector<Bounds> boxes;
    for (int k = 0; k < 1000; ++k)
        boxes.push_back({dvec3(-0.1, -0.1, k), dvec3(0.1, 0.1, k + 0.5)});
    BoxTree const tree(boxes);
    int visited = 0;
    std::vector<bool> seen(boxes.size(), false);
    tree.visit({0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}, {0.0, INFINITY}, [&](std::uint32_t box, double to) {
        ++visited;
        seen[box] = true;
        return std::min(to, 11.25); // up to z = 10.25
    });
    CHECK(std::all_of(seen.begin(), seen.begin() + 11, [](bool s) { return s; }));
    CHECK(visited < 30);
}

TEST_CASE("no boxes, lines that are not finite and lines without direction meet nothing, and do not crash") {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    auto const visits = [](BoxTree const& tree, dvec3 const& origin, dvec3 const& direction) {
        int count = 0;
        tree.visit(origin, direction, {0.0, INFINITY}, [&](std::uint32_t, double to) {
            ++count;
            return to;
        });
        return count;
    };
    CHECK(visits(BoxTree({}), dvec3(0.0), {0.0, 0.0, 1.0}) == 0);
    std::vector<Bounds> const one{{dvec3(-1.0), dvec3(1.0)}};
    BoxTree const tree(one);
    CHECK(visits(tree, dvec3(0.0), {0.0, 0.0, 1.0}) == 1);
    for (dvec3 const& direction : {dvec3(0.0), dvec3(nan, 0.0, 1.0), dvec3(0.0, INFINITY, 0.0),
                                   dvec3(1e-320, 0.0, 0.0), dvec3(1e300, 1e300, 0.0)})
        CHECK(visits(tree, dvec3(0.0), direction) <= 1);
    for (dvec3 const& origin :
         {dvec3(nan), dvec3(INFINITY, 0.0, 0.0), dvec3(1e308, 1e308, 0.0), dvec3(1e160, 0.0, 0.0)})
        CHECK(visits(tree, origin, {0.0, 0.0, 1.0}) == 0);
}

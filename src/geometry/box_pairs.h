// In: two sets of boxes. Out: the pairs, one of each, that overlap.
#pragma once

#include "geometry/embree/box_tree.h"
#include "math/inline_vector.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace sahl {

inline bool overlap(Bounds const& a, Bounds const& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
           a.low.z <= b.high.z && b.low.z <= a.high.z;
}

inline Bounds joined(Bounds const& a, Bounds const& b) {
    return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

/// Boxes halved again and again by the middle of their centres, in double: unlike BoxTree it is asked for
/// what overlaps a box, not for what a line meets.
class BoxHalves {
  public:
    explicit BoxHalves(std::span<Bounds const> boxes) : boxes_(boxes), order_(boxes.size()) {
        for (std::uint32_t i = 0; i < order_.size(); ++i)
            order_[i] = i;
        if (!order_.empty())
            halve(0, static_cast<std::uint32_t>(order_.size()));
    }

    /// Calls visitor(index) for every box that overlaps.
    template <class Visitor>
    void visit(Bounds const& box, Visitor&& visitor) const {
        InlineVector<std::uint32_t, 64> open; // one for each level at most: boxes are halved by number
        if (!nodes_.empty())
            open.push_back(0);
        while (!open.empty()) {
            Node const& node = nodes_[open.back()];
            auto const number = open.back();
            open.erase(open.end() - 1);
            if (!overlap(node.all, box))
                continue;
            if (node.right != 0) {
                open.push_back(node.right);
                open.push_back(number + 1);
                continue;
            }
            for (std::uint32_t i = node.begin; i < node.end; ++i)
                if (overlap(boxes_[order_[i]], box))
                    visitor(order_[i]);
        }
    }

  private:
    struct Node {
        Bounds all;
        std::uint32_t begin = 0, end = 0; // in order_
        std::uint32_t right = 0;          // 0: a leaf; the left half comes next
    };
    static constexpr std::uint32_t leaf_size = 6;

    void halve(std::uint32_t begin, std::uint32_t end) {
        auto const number = nodes_.size();
        Node node{boxes_[order_[begin]], begin, end, 0};
        Bounds centres{centre(order_[begin]), centre(order_[begin])};
        for (std::uint32_t i = begin; i < end; ++i) {
            node.all = joined(node.all, boxes_[order_[i]]);
            centres = joined(centres, {centre(order_[i]), centre(order_[i])});
        }
        nodes_.push_back(node);
        if (end - begin <= leaf_size)
            return;
        dvec3 const size = centres.high - centres.low;
        int const axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        auto const first = order_.begin() + begin, middle = first + (end - begin) / 2;
        std::nth_element(first, middle, order_.begin() + end,
                         [&](std::uint32_t a, std::uint32_t b) { return centre(a)[axis] < centre(b)[axis]; });
        auto const split = begin + (end - begin) / 2;
        halve(begin, split);
        nodes_[number].right = static_cast<std::uint32_t>(nodes_.size());
        halve(split, end);
    }
    dvec3 centre(std::uint32_t i) const { return boxes_[i].low + boxes_[i].high; } // twice

    std::span<Bounds const> boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

} // namespace sahl

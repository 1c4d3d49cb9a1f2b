// In: nothing. Out: what a Bvh keeps: objects in their places, and what finds them.
#pragma once

#include "geometry/embree/box_tree.h"
#include "geometry/mesh_cluster.h"
#include "geometry/placed.h"
#include "geometry/slabs.h"
#include "geometry/touching.h"

#include <array>
#include <bit>
#include <optional>
#include <vector>

namespace sahl {

struct Bvh::State {
    /// What Bvh::next is asked.
    struct Question {
        dvec3 const &origin, &direction;
        ShellSet const& inside;
        LeftSheets const& left;
        double from;
        SeenAhead const* ahead; // or none
    };

    /// Up to this many objects asking each is quicker than a hierarchy of boxes (measured: six spheres
    /// against Embree).
    static constexpr std::size_t few = 6;

    std::vector<Placed> objects;
    std::vector<std::uint32_t> unbounded;
    std::vector<std::uint32_t> bounded; // by index in the tree
    std::optional<BoxTree> tree;        // where there are many bounded objects
    static constexpr std::size_t rows = (few + boxes_at_once - 1) / boxes_at_once;
    std::array<BoxRow, rows> boxes{};       // where there are few: of `bounded`
    std::array<ShellId, few> first_shell{}; // the same; of an open one any
    std::optional<MeshCluster> cluster;     // the same
    std::uint32_t in_cluster = 0;           // a bit for each of `bounded`
    Touching touch;                         // two candidates at one place
    std::vector<MadeFlush> made_flush;
    bool lone = false;                       // one object, no shell of which touches another
    bool apart = false;                      // nothing touches anything, and no meshes share a tree
    std::optional<std::uint32_t> seen_ahead; // the mesh that rays are asked about ahead

    /// Calls ask(object) for all that the line may meet from `from` on, roughly nearest first, but for what
    /// lies beyond the horizon, which may come nearer with each.
    ///   asked   a bit for each of `bounded` that is left out, where there are few
    template <class Ask>
    void visit(Question const& question, double const& horizon, std::uint32_t asked, Ask&& ask) const;
    void choose_mesh_seen_ahead();
    /// Is the mesh that is seen ahead the first thing that visit() would ask this ray about?
    bool asks_ahead(Line const& line) const;
    /// What Placed::next says of one object, or what was seen ahead of that.
    double ask(std::uint32_t index, Question const& question, Reach reach, Candidate& found) const;
    // these write into a new hit
    void next_of_lone(Question const& question, NextHit& hit) const;
    void next_among(Question const& question, NextHit& hit) const;
    bool next_plainly(Question const& question, NextHit& hit) const;
};

template <class Ask>
void Bvh::State::visit(Question const& question, double const& horizon, std::uint32_t asked,
                       Ask&& ask) const {
    auto const& [origin, direction, inside, left, from, ahead] = question;
    for (std::uint32_t const index : unbounded)
        ask(index);
    if (tree)
        // its own copy of `ask`: the compiler need not think that what visits boxes changes the other one
        return tree->visit(origin, direction, {from, horizon},
                           [this, ask, &horizon](std::uint32_t box, double) {
                               ask(bounded[box]);
                               return horizon;
                           });
    static_assert(few <= 32);
    std::size_t const count = bounded.size();
    std::uint32_t waiting = 1; // a bit each
    std::array<double, boxes_at_once * rows> entry;
    if (count > 1) {
        Slabs const slabs(origin, direction);
        waiting = slabs.entries(boxes[0], from, horizon, entry.data());
        if (count > boxes_at_once)
            waiting |= slabs.entries(boxes[1], from, horizon, &entry[boxes_at_once]) << boxes_at_once;
        static_assert(rows == 2);
        // what the ray is in must be left: asked first, that bounds the way to anything else
        for (std::size_t i = 0; !inside.empty() && i < count; ++i)
            if (inside.contains(first_shell[i])) {
                entry[i] = -INFINITY;
                waiting |= 1u << i;
            }
    } else {
        entry[0] = -INFINITY;
    }
    waiting &= ((1u << count) - 1) & ~asked;
    while (waiting) {
        auto nearest = static_cast<std::size_t>(std::countr_zero(waiting));
        for (std::uint32_t rest = waiting & (waiting - 1); rest; rest &= rest - 1)
            if (auto const i = static_cast<std::size_t>(std::countr_zero(rest)); entry[i] < entry[nearest])
                nearest = i;
        if (entry[nearest] > horizon)
            return;
        waiting &= ~(1u << nearest);
        ask(bounded[nearest]);
    }
}

} // namespace sahl

// In: branches that are about to be traced. Out: what each will meet of the largest mesh, found by packets of
// those that go the same way, and of the others one after another.
#pragma once

#include "geometry/mesh_tree.h"
#include "scene/scene.h"
#include "trace/branch.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sahl {

/// What is found is what each branch would find alone: together that is quicker, and changes nothing.
class LookAhead {
  public:
    explicit LookAhead(Scene const& scene);

    /// A generation of so many branches begins, the first of their group or another.
    ///   may_go_alike   is it worth while to look for packets?
    void begin(std::size_t branches, bool first, bool may_go_alike);
    /// Is it worth while to add branches?
    bool wants() const { return wants_; }
    void add(std::size_t number, Branch const& branch);
    /// All were added.
    void end();

    /// None: nothing is known.
    SeenAhead const* at(std::size_t number) const {
        return number < seen_.size() && seen_[number].known ? &seen_[number] : nullptr;
    }

  private:
    /// Branches that start close to the first of them and go much the same way.
    struct Packet {
        InlineVector<std::uint32_t, Bvh::most_together> numbers;
        InlineVector<Bvh::Line, Bvh::most_together> lines;
    };
    bool fits(Packet const& packet, Branch const& branch) const;
    Packet& packet_for(Branch const& branch);
    void look(Packet& packet);
    void look_in_turn(std::uint32_t number, Bvh::Line const& line);
    void look_in_turn();

    Bvh const& bvh_;
    double near_ = 0.0; // m, squared
    bool wants_ = false, in_packets_ = false;
    Packet alone_;                  // what goes no way in particular
    std::array<Packet, 4> packets_; // that are not full yet
    std::size_t next_ = 0;          // which of them is given up for a new one
    std::size_t added_ = 0, together_ = 0;
    std::vector<SeenAhead> seen_; // by number
};

} // namespace sahl

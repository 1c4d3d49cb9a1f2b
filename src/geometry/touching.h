// In: objects in their places. Out: which of their faces lie on each other, found once; and for what a ray
// meets at one place, whether it is one boundary. Curved patches of meshes will join here: one more kind of
// part, one more way to fit.
#pragma once

#include "geometry/made_flush.h"
#include "geometry/placed.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace sahl {

class Touching {
  public:
    Touching() = default;
    explicit Touching(std::span<Placed const> objects);

    /// Are two crossings that lie within rounding of each other on faces that lie on each other?
    bool operator()(Candidate const& one, Candidate const& other) const {
        return has(one, other.object) && has(other, one.object);
    }

    /// The objects that touch where the crossing lies.
    std::span<std::uint32_t const> at(Candidate const& crossing) const {
        auto const& sets = set_of_part_[crossing.object];
        if (sets.empty())
            return {};
        auto const part =
            crossing.primitive < 0 ? crossing.face : static_cast<std::uint32_t>(crossing.primitive);
        return sets_[sets[part]];
    }

    /// Does anything of one object touch anything of the other?
    bool objects(std::uint32_t one, std::uint32_t other) const {
        return std::binary_search(objects_.begin(), objects_.end(),
                                  std::pair<std::uint32_t, std::uint32_t>(std::minmax(one, other)));
    }

    bool none() const { return objects_.empty(); }

    /// Pairs of faces, each once; of meshes those faces that have triangles in contact.
    std::vector<std::pair<FaceId, FaceId>> const& faces() const { return faces_; }

    /// Faces of exact shapes that touch at a point.
    bool at_a_point(std::uint32_t one, std::uint32_t other) const { // one < other
        return std::binary_search(tangent_objects_.begin(), tangent_objects_.end(), std::pair(one, other));
    }
    std::vector<Bvh::Tangency> const& tangencies() const { return tangencies_; }

    /// All triangles that lie on something, if some of them do so only but for the rounding of float data;
    /// those do not touch before they are made flush.
    std::vector<PlacedFit> const& to_make_flush() const { return to_make_flush_; }

  private:
    struct Part {
        std::uint32_t object, part, touches;
        auto operator<=>(Part const&) const = default;
    };
    struct Search;

    bool has(Candidate const& crossing, std::uint32_t other) const {
        auto const touching = at(crossing);
        return std::find(touching.begin(), touching.end(), other) != touching.end();
    }

    // by object, by face of an exact shape or triangle of a mesh: which objects it touches, as a number in
    // sets_; empty for an object that touches none
    std::vector<std::vector<std::uint32_t>> set_of_part_;
    std::vector<std::vector<std::uint32_t>> sets_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> objects_; // (lower, higher), in order
    std::vector<std::pair<std::uint32_t, std::uint32_t>> tangent_objects_;
    std::vector<std::pair<FaceId, FaceId>> faces_;
    std::vector<Bvh::Tangency> tangencies_;
    std::vector<PlacedFit> to_make_flush_;
};

/// Objects whose boxes, grown by a share of their sizes that is far above rounding, overlap: (lower number,
/// higher number), in order.
std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours(std::span<Placed const> objects,
                                                                double grown_by = 0.0);

} // namespace sahl

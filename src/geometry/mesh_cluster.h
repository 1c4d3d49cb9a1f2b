// In: closed meshes in their places, each there once. Out: the next crossing of each along a ray, from one
// traversal of a tree that holds all their triangles.
#pragma once

#include "geometry/embree/triangle_tree.h"
#include "geometry/placed.h"

#include <optional>
#include <span>
#include <vector>

namespace sahl {

class MeshCluster {
  public:
    static constexpr std::size_t most = 6; // members

    /// Of the objects those whose triangles may share a tree: met as meshes, of like size, close together,
    /// and scaled alike in all directions. None: fewer than two.
    static std::optional<MeshCluster> of(std::span<Placed const> objects);

    bool holds(std::uint32_t object) const;

    /// Candidates, the nearest of which is the next crossing of all members but those in `alone`, which are
    /// to be asked alone; each member's own, if it lies at that place. False, with nothing in either, where
    /// float leaves a doubt: then all are.
    bool next(std::span<Placed const> objects, dvec3 const& origin, dvec3 const& direction,
              ShellSet const& inside, double from, InlineVector<Candidate, most>& found,
              InlineVector<std::uint32_t, most>& alone) const;

  private:
    struct Member {
        std::uint32_t object, first_triangle;
    };
    MeshCluster(std::vector<Member> members, TriangleTree triangles)
        : members_(std::move(members)), triangles_(std::move(triangles)) {}

    /// May a member of which nothing was proposed up to reach.to be crossed there? What a ray leaves or
    /// enters along a face may go unproposed; see MeshTree::may_hide.
    bool may_be_crossed(Placed const& object, dvec3 const& origin, dvec3 const& direction,
                        ShellSet const& inside, Reach reach) const;

    std::vector<Member> members_;
    TriangleTree triangles_;
};

} // namespace sahl

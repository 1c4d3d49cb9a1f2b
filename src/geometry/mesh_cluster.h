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

    /// Candidates, the nearest of which is the next crossing of all members; each member's own, if it lies at
    /// that place. False, with nothing in `found`, where float leaves a doubt: the members are then to be
    /// asked one by one.
    bool next(std::span<Placed const> objects, dvec3 const& origin, dvec3 const& direction,
              ShellSet const& inside, double from, InlineVector<Candidate, most>& found) const;

  private:
    struct Member {
        std::uint32_t object, first_triangle;
    };
    MeshCluster(std::vector<Member> members, TriangleTree triangles)
        : members_(std::move(members)), triangles_(std::move(triangles)) {}

    std::vector<Member> members_;
    TriangleTree triangles_;
};

} // namespace sahl

// In: what Embree proposes of a curved mesh's cage along a ray. Out: the next crossing of the curved surface,
// where all that is proposed is steep; or that there is a doubt.
#pragma once

#include "geometry/curved_tree.h"
#include "math/inline_vector.h"

namespace sahl {

class CurvedQuery {
  public:
    ///   behind   t between where a steep line goes through the cage and where it goes through the surface,
    ///   at
    ///            the most
    ///   blur     of a proposal's t
    CurvedQuery(CurvedTree const& tree, dvec3 const& origin, dvec3 const& direction, InsideShells inside,
                double from, double rounding, double behind, double blur)
        : tree_(tree), origin_(origin), direction_(direction), inside_(inside), from_(from),
          rounding_(rounding), near_(behind + blur) {
        for (std::uint32_t shell = 0; shell < tree.mesh().shells.size(); ++shell)
            in_some_ = in_some_ || inside[shell];
    }

    /// Is the ray in some shell of the mesh? It must then be left somewhere.
    bool in_some() const { return in_some_; }

    /// What a visitor of a TriangleTree returns: the farthest t that matters once this is known.
    double take(Proposal const& proposal) {
        constexpr double no = INFINITY;
        std::uint32_t const owner = tree_.owner_[proposal.triangle], triangle = owner & ~PatchCage::doubtful;
        if (proposal.sense == 0 || triangle != owner) {
            doubt_ = std::min(doubt_, proposal.t);
            return no;
        }
        if ((proposal.sense < 0) == inside_[tree_.mesh().shell_of(triangle)]) {
            if (proposal.t > from_ + near_) // otherwise it is the one that the ray started on
                doubt_ = std::min(doubt_, proposal.t);
            return no;
        }
        // asked for now, it is there when Embree is through
        tree_.prefetch(triangle);
        if (proposals_.full()) {
            doubt_ = -INFINITY;
            return no;
        }
        proposals_.push_back({triangle, proposal.t});
        return proposal.t > from_ + near_ ? proposal.t + 2.0 * near_ : no;
    }

    /// Writes the answer up to t = `to`, where no doubt is left; otherwise returns false.
    bool settle(double to, CurvedAnswer& answer) const;

  private:
    struct Proposed {
        std::uint32_t triangle;
        double t;
    };
    bool meet(Proposed const& proposed, CurvedCrossing& crossing) const;

    CurvedTree const& tree_;
    dvec3 origin_, direction_;
    InsideShells inside_;
    double from_, rounding_, near_;
    bool in_some_ = false;
    double doubt_ = INFINITY; // t of the nearest place of the cage that is not crossed plainly
    InlineVector<Proposed, 16> proposals_;
};

} // namespace sahl

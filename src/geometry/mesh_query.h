// In: what Embree proposes to one mesh along a ray. Out: the mesh's next crossing, met in double; or that
// float leaves a doubt.
#pragma once

#include "geometry/embree/triangle_tree.h"
#include "geometry/mesh_tree.h"
#include "math/inline_vector.h"

namespace sahl {

class MeshQuery {
  public:
    /// In the mesh's own frame; no frame moves t.
    ///   from       t: what is asked for lies beyond
    ///   rounding   m: what lies within this of the start, measured along the normal, is at the start
    ///   blur       of a proposal's t
    MeshQuery(MeshTree const& tree, dvec3 const& origin, dvec3 const& direction, double unit,
              InsideShells inside, double from, double rounding, double blur)
        : tree_(tree), origin_(origin), direction_(direction), unit_(unit), inside_(inside), from_(from),
          rounding_(rounding), blur_(blur),
          beyond_(2.0 * blur + 4.0 / TriangleTree::sure_slope * rounding / unit),
          shells_(tree.mesh().shells.size()) {
        for (std::uint32_t shell = 0; shell < shells_; ++shell)
            in_some_ = in_some_ || inside[shell];
    }

    /// Is the ray in some shell of the mesh? It must then be left somewhere.
    bool in_some() const { return in_some_; }

    /// What a visitor of a TriangleTree returns: the farthest t that matters once this is known.
    double take(std::uint32_t triangle, double t, int sense) {
        constexpr double no = INFINITY;
        if (sense != 0 && (sense < 0) == is_in(triangle)) {
            if (t > from_ + blur_) // otherwise it is the one that the ray started on
                unfit_ = std::min(unfit_, t - blur_);
            return no;
        }
        // asked for now, it is there when Embree is through: met at once, half the time was waiting for it
        tree_.prefetch(triangle);
        if (proposals_.full()) {
            too_many_ = true;
            return no;
        }
        proposals_.push_back({triangle, t, sense});
        return sense != 0 && t > from_ + blur_ ? t + beyond_ : no;
    }

    /// Writes the crossing that there is, or none, where no doubt is left; otherwise returns false.
    ///   looked_to   t up to which all was proposed
    bool settle(double looked_to, std::optional<MeshCrossing>& crossing) const;

  private:
    bool is_in(std::uint32_t triangle) const {
        return shells_ == 1 ? in_some_ : inside_[tree_.mesh().triangle_shell[triangle]];
    }

    MeshTree const& tree_;
    dvec3 origin_, direction_;
    double unit_;
    InsideShells inside_;
    double from_, rounding_, blur_;
    double beyond_; // what is met at a slope that float tells lies no farther beyond its t than this, with
                    // all that is at one place with it
    std::size_t shells_;
    bool in_some_ = false, too_many_ = false;
    double unfit_ = INFINITY; // t of the nearest crossing that contradicts `inside`
    InlineVector<Proposal, 16> proposals_;
};

} // namespace sahl

// In: a patch and its relief. Out: where any line meets it, grazing ones included. Its cell is what triangles
// x = Σ w_k (p_k + h up_k) of all heights h fill; two that share a side share its wall, and on it the
// surface. So a surface has neither gap nor overlap there, and its crossings alternate like those of the
// triangles.
#pragma once

#include "geometry/patch_relief.h"

#include <optional>

namespace sahl {

/// A place in a cell, and the surface there.
struct CellPlace {
    double v = 0.0, w = 0.0, h = 0.0; // weights of the second and third corner, and height
    double above = 0.0;               // m: h over the surface's height; > 0 outside
    dvec3 gradient{0.0};              // of that, in space
    double least_weight() const;
};

class PatchCell {
  public:
    PatchCell(Patch const& patch, Relief const& relief) : patch_(patch), relief_(relief) {}

    /// `place` is a guess, and the answer.
    void locate(dvec3 const& point, CellPlace& place) const;

    struct Root {
        double t = 0.0;
        CellPlace at;
    };
    /// Where a line goes out of the body (rises) or into it, `slack` (a weight) outside the cell at most.
    std::optional<Root> root(dvec3 const& origin, dvec3 const& direction, bool rises, double slack) const;

  private:
    bool holds(CellPlace const& place, double slack) const;

    Patch const& patch_;
    Relief const& relief_;
};

} // namespace sahl

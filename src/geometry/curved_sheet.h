// In: an open mesh and a ray in the mesh's own frame. Out: where the ray meets the curved surface that the
// mesh stands for, as mesh_sheet.h has it of its triangles.
#pragma once

#include "geometry/curved_tree.h"

#include <optional>

namespace sahl {

class CurvedSheet {
  public:
    CurvedSheet(std::shared_ptr<Mesh const> mesh, PatchKind kind) : patches_(std::move(mesh), kind) {}

    /// As MeshSheet::next; `enters` of what is met: the ray comes against the normal.
    std::optional<CurvedCrossing> next(dvec3 const& origin, dvec3 const& direction, Reach reach,
                                       double rounding, std::optional<bool> above) const;

    /// As MeshSheet::heads_above.
    std::optional<bool> heads_above(dvec3 const& point, dvec3 const& direction, double rounding) const;

    Mesh const& mesh() const { return patches_.mesh(); }
    Bounds const& box() const { return patches_.box(); }
    double blur(std::uint32_t triangle, double rounding) const { return patches_.blur(triangle, rounding); }

  private:
    CurvedTree patches_;
};

} // namespace sahl

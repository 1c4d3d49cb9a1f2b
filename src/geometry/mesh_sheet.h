// In: an open mesh and a ray in the mesh's own frame. Out: where the ray meets it next, in double.
// It has no inside: what matters is the side that a ray comes from.
#pragma once

#include "geometry/embree/box_tree.h"
#include "geometry/mesh.h"

#include <memory>
#include <optional>

namespace sahl {

struct SheetMeeting {
    double t = 0.0;
    double slope = 0.0; // |n·d|
    double range = 0.0; // of t over the triangle's corners
    dvec2 uv{0.0};      // weights of the triangle's second and third corner
    std::uint32_t triangle = 0;
    bool against = false; // the ray comes against the triangle's normal

    /// How far rounding (m, along the normal) may shift t.
    double blur(double rounding) const { return std::min(rounding / slope, range); }
};

class MeshSheet {
  public:
    explicit MeshSheet(std::shared_ptr<Mesh const> mesh);

    /// The nearest meeting between reach.from and reach.to. A triangle reaches as far as rounding beyond its
    /// edges, so that no line slips between two.
    ///   rounding   m: what lies within this of the ray's start, measured along the normal, is at the start
    ///   above      the ray starts on the sheet, on this side: a triangle at the start that it goes away from
    ///              on that side is the one it has left
    std::optional<SheetMeeting> next(dvec3 const& origin, dvec3 const& direction, Reach reach,
                                     double rounding, std::optional<bool> above) const;

    /// Where the point lies on the sheet to within rounding: does the direction lead to the normal's side?
    std::optional<bool> heads_above(dvec3 const& point, dvec3 const& direction, double rounding) const;

    Mesh const& mesh() const { return *mesh_; }
    std::array<std::uint32_t, 3> const& vertices(std::uint32_t triangle) const {
        return mesh_->soup.triangles[triangle];
    }
    dvec3 normal(std::uint32_t triangle) const; // unit, by the triangle's winding
    /// The point of the triangle that is nearest to `point`, or nearly so where that is of its border.
    dvec3 onto(std::uint32_t triangle, dvec3 const& point) const;

  private:
    std::optional<SheetMeeting> meet(dvec3 const& origin, dvec3 const& direction, double rounding,
                                     std::uint32_t triangle) const;

    std::shared_ptr<Mesh const> mesh_;
    BoxTree tree_;
};

} // namespace sahl

// In: an open mesh and a ray in the mesh's own frame. Out: where the ray meets it next, in double.
// It has no inside: what matters is the side that a ray comes from.
#pragma once

#include "geometry/embree/box_tree.h"
#include "geometry/mesh.h"

#include <cmath>
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

/// What of the meetings of a line with a sheet lies ahead of where a ray is on it. From its start a ray meets
/// what lies ahead. Farther on, where a boundary was passed in silence, the sheet may lie on that boundary.
struct AheadOnSheet {
    Reach reach;
    double rounding; // as MeshSheet::next has it, with what follows
    std::optional<bool> above;

    /// Where the line's search begins: a meeting that grazes at 1e-6 rad and lies within the rounding of the
    /// start along its normal is found.
    double start(dvec3 const& direction) const { return reach.from - 1e6 * rounding / length(direction); }
    bool holds(double t, double slope, bool against) const {
        double const margin = reach.from > 0.0 ? rounding : 0.0;
        bool const left = above && std::abs(t) * slope <= rounding && against != *above;
        return (t - reach.from) * slope >= -margin && !left;
    }
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

// In: a closed mesh and a ray in the mesh's own frame. Out: the next crossing of the curved surface that the
// mesh stands for: a patch over each triangle, found by its own box, so that silhouettes and grazing rays are
// the surface's.
#pragma once

#include "geometry/embree/box_tree.h"
#include "geometry/embree/triangle_tree.h"
#include "geometry/mesh_tree.h"
#include "geometry/patch_fields.h"
#include "geometry/patch_fill.h"
#include "geometry/patch_relief.h"
#include "geometry/smooth_fans.h"

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace sahl {

struct CurvedCrossing {
    double t = 0.0;
    double slope = 0.0;   // |n·d|
    dvec3 point{0.0};     // on the surface
    dvec3 normal{0.0};    // unit, out of the volume that the shell encloses: for light
    dvec3 geometric{0.0}; // the same of the surface itself; differs where patches do not quite agree
    dvec2 uv{0.0};
    std::uint32_t triangle = 0;
    bool enters = false;
    bool recovered = false;
};

struct CurvedAnswer {
    std::optional<CurvedCrossing> crossing;
    double contradiction = INFINITY; // as MeshAnswer's
};

class CurvedTree {
  public:
    CurvedTree(std::shared_ptr<Mesh const> mesh, PatchKind kind);

    /// As MeshTree::next.
    CurvedAnswer next(dvec3 const& origin, dvec3 const& direction, InsideShells inside, Reach reach,
                      double rounding) const;

    /// For each shell: does the ray run inside it just after its start?
    std::vector<bool> inside(dvec3 const& origin, dvec3 const& direction, double rounding) const;

    Mesh const& mesh() const { return *fans_->mesh; }
    SmoothFans const& fans() const { return *fans_; }
    PatchKind kind() const { return kind_; }
    /// The box of the patches.
    Bounds const& box() const { return box_; }
    /// How far (m, along the normal) rounding may shift a crossing with a triangle's patch, that of fitting
    /// the same data twice included.
    double blur(std::uint32_t triangle, double rounding) const {
        return patch(triangle).flat ? rounding : rounding + fit_blur_;
    }
    /// Bytes a triangle that this takes beyond the mesh itself and Embree's tree, when every vertex is
    /// fitted.
    double bytes_per_triangle() const;

    /// Share of triangles over which the quadratic surface, or a chord where there is no crease, stands in
    /// for all or a part of what is fitted: of a few thousand spread over the mesh.
    double share_stood_in() const;

    /// Asks for a patch ahead of its use.
    void prefetch(std::uint32_t triangle) const { patches_[triangle].prefetch(); }
    /// With heights and tilts, made when first asked for, by any thread.
    Patch const& patch(std::uint32_t triangle) const {
        Patch const& patch = patches_[triangle];
        if (patch.made.load(std::memory_order_acquire) == Patch::bare)
            make(triangle);
        return patch;
    }

    /// Where the line through a place along its triangle's normal meets the patch.
    std::optional<CurvedCrossing> foot(std::uint32_t triangle, dvec3 const& place) const;

  private:
    friend class CurvedQuery;
    friend class CurvedSheet;
    /// How a line is met with the patches that its boxes leave.
    struct Care {
        bool thorough = false; // by samples all along the line, whatever a patch is like
        double overlap = 0.0;  // weight: how far beside a patch it may be met
        double rounding = 0.0; // m
    };
    /// Is it met beside its patch by more than rounding can move it? Where a line runs along an edge, the
    /// overlap of cells is many roundings wide.
    ///   unit, rounding   the direction's length; m, along the normal
    bool lies_beside(CurvedCrossing const& crossing, double unit, double rounding) const;
    /// Every place that the line may meet, grazing or not, by the patches' boxes.
    std::optional<CurvedCrossing> nearest(dvec3 const& origin, dvec3 const& direction, InsideShells inside,
                                          Reach reach, Care const& care) const;
    CurvedAnswer next_by_boxes(dvec3 const& origin, dvec3 const& direction, InsideShells inside, Reach reach,
                               double rounding) const;
    std::optional<CurvedCrossing> meet(std::uint32_t triangle, dvec3 const& origin, dvec3 const& direction,
                                       bool rises, double from, Care const& care) const;

    /// Where no patch gives a ray that is inside a way out: through the triangles.
    CurvedAnswer through_triangles(dvec3 const& origin, dvec3 const& direction, InsideShells inside,
                                   Reach reach, double rounding) const;
    void make(std::uint32_t triangle) const;
    std::span<Patch const> patches() const { return {patches_.get(), fans_->triangles.size()}; }

    std::shared_ptr<SmoothFans const> fans_;
    PatchKind kind_;
    std::unique_ptr<Patch[]> patches_;
    std::vector<Relief> reliefs_;
    std::optional<LazyFields> fields_;
    mutable std::array<std::mutex, 64> making_;
    double fit_blur_ = 0.0; // m
    Bounds box_;
    std::optional<TriangleTree> cage_;
    std::vector<std::uint32_t> owner_; // of the cage's triangles
    double thickness_ = 0.0;           // m, of the layer between the cage and the triangles
    double behind_ = 0.0;              // m along a steep line, between the cage and the surface
    std::optional<BoxTree> boxes_;
    mutable std::once_flag triangles_built_;
    mutable std::unique_ptr<MeshTree const> triangles_; // built on first need
};

} // namespace sahl

// In: a closed mesh and a ray in the mesh's own frame. Out: the next crossing of the curved surface that the
// mesh stands for: a patch over each triangle, found by its own box, so that silhouettes and grazing rays are
// the surface's.
#pragma once

#include "geometry/embree/box_tree.h"
#include "geometry/mesh_tree.h"
#include "geometry/patch_cell.h"
#include "geometry/smooth_fans.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace sahl {

/// What runs through a triangle's corners.
enum class PatchKind : std::uint8_t {
    quadratic, // heights over the chords by the normals at their ends; the light's normal is the corners',
               // weighted
    fitted,    // polynomials of degree 4, one at each vertex, weighted
    apart      // as fitted, but for light's normals, which those of the farther corners give: for pilots
};

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

/// Polynomials by fan, fitted when first asked for, by any thread.
class LazyFields {
  public:
    explicit LazyFields(std::shared_ptr<SmoothFans const> fans);
    ~LazyFields();
    LazyFields(LazyFields const&) = delete;
    LazyFields& operator=(LazyFields const&) = delete;

    /// Nothing where no polynomial describes the surface there better than the quadratic patch.
    HeightField const* at(std::uint32_t fan, std::vector<PatchCell> const& cells) const {
        HeightField const* const known = slots_[fan].load(std::memory_order_acquire);
        return known == nullptr ? fit(fan, cells) : known == &none_ ? nullptr : known;
    }
    std::size_t fitted() const; // so far

  private:
    HeightField const* fit(std::uint32_t fan, std::vector<PatchCell> const& cells) const;
    std::shared_ptr<SmoothFans const> fans_;
    mutable std::vector<std::atomic<HeightField const*>> slots_;
    HeightField none_{};
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
    /// How far (m, along the normal) rounding may shift a crossing, that of fitting the same data twice
    /// included.
    double blur(double rounding) const { return rounding + fit_blur_; }
    /// Bytes a triangle that this takes beyond the mesh itself and Embree's tree, when every vertex is
    /// fitted.
    double bytes_per_triangle() const;

  private:
    std::optional<CurvedCrossing> meet(std::uint32_t triangle, dvec3 const& origin, dvec3 const& direction,
                                       bool rises, double slack) const;
    std::optional<CurvedCrossing> nearest(dvec3 const& origin, dvec3 const& direction, InsideShells inside,
                                          Reach reach, double rounding, double slack) const;

    /// Where no patch gives a ray that is inside a way out: through the triangles.
    CurvedAnswer through_triangles(dvec3 const& origin, dvec3 const& direction, InsideShells inside,
                                   Reach reach, double rounding) const;

    std::shared_ptr<SmoothFans const> fans_;
    PatchKind kind_;
    std::vector<PatchCell> cells_;
    double fit_blur_ = 0.0; // m
    std::optional<LazyFields> fields_;
    Bounds box_;
    std::optional<BoxTree> boxes_;
    mutable std::once_flag triangles_built_;
    mutable std::unique_ptr<MeshTree const> triangles_; // built on first need
};

} // namespace sahl

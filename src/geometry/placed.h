// In: one geometry, its place, and a ray in the world. Out: its next crossing, met in its own frame.
#pragma once

#include "geometry/bvh.h"
#include "geometry/contact.h"
#include "geometry/curved_sheet.h"
#include "geometry/curved_tree.h"
#include "geometry/mesh_sheet.h"
#include "geometry/mesh_tree.h"
#include "geometry/revolved.h"
#include "geometry/sheet.h"
#include "geometry/solid.h"

#include <optional>

namespace sahl {

/// A crossing before it is known to be the nearest; t = ∞: none.
struct Candidate {
    double t = INFINITY;
    double blur = 0.0; // how far rounding may shift t
    std::uint32_t object = 0;
    std::uint32_t face = 0; // local number
    std::int32_t primitive = -1;
    dvec2 uv{0.0};
    dvec3 normal{0.0}; // of a triangle: local, unit, out of the shell's volume
    bool open = false;
    bool enters = false;
    bool recovered = false;   // met by a line that misses it by no more than rounding
    bool well_within = false; // a triangle, far from its border
    // of a curved mesh: local, where it is met, and the surface's own normal; `normal` is that for light
    dvec3 point{0.0}, geometric{0.0};
};

struct Placed {
    PlacedGeometry geometry;
    std::variant<Shape, Solid, std::shared_ptr<MeshTree const>, std::shared_ptr<MeshSheet const>,
                 std::shared_ptr<RevolvedSheet const>, std::shared_ptr<CurvedTree const>,
                 std::shared_ptr<CurvedSheet const>>
        met_by;                                  // a Shape here is open and flat
    std::vector<std::uint32_t> face_of_region{}; // of a mesh recognised as a solid: its faces, of the mesh's
    Affine to_local{};
    bool moved = false;    // to_world is not the identity
    double rounding = 0.0; // m, local: at a start near the geometry's own origin; grows with distance
    double extent = 0.0;   // m, local: how far it reaches from its origin; ∞ for a plane
    Bounds box;            // world
    bool bounded = true;

    struct LocalRay {
        dvec3 origin, direction;
        double rounding;
    };
    LocalRay local(dvec3 const& origin, dvec3 const& direction) const;

    /// Of a closed mesh.
    Candidate candidate(MeshCrossing const& crossing, LocalRay const& ray) const;

    /// Writes the next crossing at t ≥ reach.from, if there is one up to reach.to; returns t from which on
    /// what is met contradicts `inside` (∞: nothing does).
    ///   above   of an open geometry that the ray starts on: on which side
    double next(dvec3 const& origin, dvec3 const& direction, ShellSet const& inside, Reach reach,
                std::optional<bool> above, Candidate& found) const;

    /// Is it met at a slope so small that float does not tell its sign?
    bool grazes(Candidate const& found, dvec3 const& origin, dvec3 const& direction) const {
        LocalRay const ray = local(origin, direction);
        return found.blur * length(ray.direction) * TriangleTree::sure_slope > ray.rounding;
    }

    /// What next() writes, of a closed mesh from its boxes in double; others leave `found` as it is.
    void next_exact(dvec3 const& origin, dvec3 const& direction, ShellSet const& inside, Reach reach,
                    Candidate& found) const;

    /// The shells that a ray is in behind a crossing of this object.
    ShellSet after(Candidate const& candidate, ShellSet const& inside) const;

    /// Appends what a ray starting here is in or on.
    void start(dvec3 const& origin, dvec3 const& direction, std::uint32_t index, Bvh::Start& into) const;

    /// Of an open geometry: is the place on it, of a flat one on its plane?
    bool lies_at(dvec3 const& point) const;

    /// The crossing with its point and normals in the world. What rounding puts before `from` is met there: a
    /// ray that went back along a face that it grazes would come out beside it.
    Crossing finished(Candidate const& candidate, dvec3 const& origin, dvec3 const& direction,
                      double from) const;

    /// See Bvh::turning; the face by its local number.
    dmat3 turning(std::uint32_t face, std::int32_t primitive, dvec3 const& point, dvec3 const& normal) const;

    std::uint32_t face_count() const; // of what it is met as
    /// The number of such a face among those of the geometry.
    std::uint32_t local_face(std::uint32_t face) const {
        return face_of_region.empty() ? face : face_of_region[face];
    }
    Carriers carriers(std::uint32_t face) const; // of an exact shape
    Mesh const* mesh() const;                    // none: an exact shape
    bool exact() const { return !mesh(); }
};

/// What meets a mesh: one of these.
struct MeshMeeting {
    std::shared_ptr<MeshTree const> tree{};
    std::shared_ptr<MeshSheet const> sheet{};
    std::shared_ptr<CurvedTree const> curved{};
    std::shared_ptr<CurvedSheet const> curved_sheet{};
};

Placed place(PlacedGeometry geometry, MeshMeeting mesh);

/// The same place met as the solid that its mesh was recognised as, if it was.
std::optional<Placed> recognised(Placed const& placed);

} // namespace sahl

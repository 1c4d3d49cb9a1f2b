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

#include <limits>
#include <optional>

namespace sahl {

/// A crossing before it is known to be the nearest; t = ∞: none.
struct Candidate {
    double t = INFINITY;
    double blur = 0.0; // how far rounding may shift t
    std::uint32_t object = 0;
    std::uint32_t face = 0; // local number
    std::int32_t primitive = -1;
    dvec2 uv;     // of a triangle
    dvec3 normal; // of a triangle: local, unit, out of the shell's volume
    bool open = false;
    bool enters = false;
    bool recovered = false;   // met by a line that misses it by no more than rounding
    bool well_within = false; // a triangle, far from its border
    // of a curved mesh: local, where it is met, and the surface's own normal; `normal` is that for light
    dvec3 point, geometric;

    Candidate() {} // by hand: the compiler's own would clear the vectors too
    /// Of an exact shape.
    void set(double at, double may_shift, std::uint32_t of_face, bool of_sheet, bool inward) {
        t = at;
        blur = may_shift;
        face = of_face;
        primitive = -1;
        open = of_sheet;
        enters = inward;
        recovered = well_within = false;
    }
    /// Of a mesh.
    void set(double at, double may_shift, std::uint32_t of_face, bool of_sheet, bool inward,
             std::uint32_t triangle, dvec2 const& place, dvec3 const& across) {
        set(at, may_shift, of_face, of_sheet, inward);
        primitive = static_cast<std::int32_t>(triangle);
        uv = place;
        normal = across;
    }
};

/// Ulps of the coordinates involved within which a ray is still where it started: carrying a point to the
/// world and back, and solving for t, round some ten times each; the rest is margin.
constexpr double start_ulps = 64.0 * std::numeric_limits<double>::epsilon();

/// Of an open geometry that a ray starts on: on which side.
inline std::optional<bool> side_of(LeftSheets const& left, std::uint32_t object) {
    for (LeftSheet const& sheet : left)
        if (sheet.object == object)
            return bool(sheet.above);
    return std::nullopt;
}

struct Placed {
    PlacedGeometry geometry;
    std::variant<Shape, Solid, std::shared_ptr<MeshTree const>, std::shared_ptr<MeshSheet const>,
                 std::shared_ptr<RevolvedSheet const>, std::shared_ptr<CurvedTree const>,
                 std::shared_ptr<CurvedSheet const>>
        met_by;                                  // a Shape here is open and flat
    std::vector<std::uint32_t> face_of_region{}; // of a mesh recognised as a solid: its faces, of the mesh's
    Affine to_local{};
    bool moved = false;    // to_world is not the identity
    bool turned = false;   // nor a shift
    double rounding = 0.0; // m, local: at a start near the geometry's own origin; grows with distance
    double extent = 0.0;   // m, local: how far it reaches from its origin; ∞ for a plane
    Bounds box;            // world
    bool bounded = true;

    struct LocalRay {
        dvec3 origin, direction;
        double rounding;
    };
    LocalRay local(dvec3 const& origin, dvec3 const& direction) const {
        dvec3 const o = turned ? to_local.point(origin) : moved ? origin + to_local.offset : origin;
        double const distance = std::abs(o.x) + std::abs(o.y) + std::abs(o.z); // at least the length of o
        return {o, turned ? to_local.vector(direction) : direction, rounding + start_ulps * distance};
    }

    /// Of a closed mesh.
    Candidate candidate(MeshCrossing const& crossing, LocalRay const& ray) const;

    /// Writes the next crossing at t ≥ reach.from, if there is one up to reach.to; returns t from which on
    /// what is met contradicts `inside` (∞: nothing does).
    ///   left    among them this one, if it is open and the ray starts on it; `index` is its own there
    [[gnu::always_inline]] double next(dvec3 const& origin, dvec3 const& direction, ShellSet const& inside,
                                       Reach reach, LeftSheets const& left, std::uint32_t index,
                                       Candidate& found) const {
        LocalRay const ray = local(origin, direction);
        // what most scenes are made of first, each a short function of its own
        if (Solid const* const solid = std::get_if<Solid>(&met_by))
            return next_of(*solid, ray, inside, reach, found);
        if (Shape const* const sheet = std::get_if<Shape>(&met_by))
            return next_of(*sheet, ray, reach, side_of(left, index), found);
        return next_of_others(ray, inside, reach, side_of(left, index), found);
    }

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

    /// Writes the crossing with its point and normals in the world. What rounding puts before `from` is met
    /// there: a ray that went back along a face that it grazes would come out beside it.
    void finish(Candidate const& candidate, dvec3 const& origin, dvec3 const& direction, double from,
                Crossing& crossing) const;

    /// See Bvh::turning; the face by its local number.
    dmat3 turning(std::uint32_t face, std::int32_t primitive, dvec3 const& point, dvec3 const& normal) const;

    std::uint32_t face_count() const; // of what it is met as
    /// The number of such a face among those of the geometry.
    std::uint32_t local_face(std::uint32_t face) const {
        return face_of_region.empty() ? face : face_of_region[face];
    }
    Carriers carriers(std::uint32_t face) const; // of an exact shape
    double next_of(Solid const& solid, LocalRay const& ray, ShellSet const& inside, Reach reach,
                   Candidate& found) const;
    double next_of(Shape const& sheet, LocalRay const& ray, Reach reach, std::optional<bool> above,
                   Candidate& found) const;
    double next_of_others(LocalRay const& ray, ShellSet const& inside, Reach reach, std::optional<bool> above,
                          Candidate& found) const;
    Mesh const* mesh() const; // none: an exact shape
    bool exact() const { return !mesh(); }
};

inline double Placed::next_of(Shape const& sheet, LocalRay const& ray, Reach reach, std::optional<bool> above,
                              Candidate& found) const {
    if (above && *above == (ray.direction.z > 0.0)) // it goes away from the whole plane
        return INFINITY;
    if (auto const t = meet(sheet, ray.origin, ray.direction)) {
        double const blur = ray.rounding / std::abs(ray.direction.z);
        if (*t >= reach.from - blur && *t <= reach.to)
            found.set(*t, blur, 0, true, ray.direction.z < 0.0);
    }
    return INFINITY;
}

inline double Placed::next_of(Solid const& solid, LocalRay const& ray, ShellSet const& inside, Reach reach,
                              Candidate& found) const {
    bool const in = inside.contains(geometry.first_shell);
    auto const c = solid.next(ray.origin, ray.direction, in, reach.from, ray.rounding);
    if (!c)
        return in ? reach.from : INFINITY;
    if (c->t <= reach.to)
        found.set(c->t, c->slope > 0.0 ? ray.rounding / c->slope : INFINITY, c->face, false, c->enters);
    return INFINITY;
}

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

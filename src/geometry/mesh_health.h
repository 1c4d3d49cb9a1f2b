// In: a mesh as make_mesh leaves it. Out: what is wrong with it and where, for a report. Nothing is changed.
#pragma once

#include "geometry/mesh.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sahl {

/// So many, and where the first few of them are (in the mesh's own frame, m).
struct Found {
    static constexpr std::size_t shown = 5;
    std::uint64_t count = 0;
    std::vector<dvec3> places;

    void add(dvec3 const& place) {
        ++count;
        if (places.size() < shown)
            places.push_back(place);
    }
};

/// A closed way along the rim of the surface: the edge of a hole, or the outline of an open sheet.
struct Border {
    dvec3 centre{0.0};   // mean of its edges' middles, by length
    double length = 0.0; // m
    std::uint64_t edges = 0;
};

struct ShellHealth {
    std::uint64_t triangles = 0;
    bool closed = true;  // no border; shells with crowded edges may be
    int sign = 1;        // +1: a body; −1: a cavity
    double volume = 0.0; // m³; 0 where it is open
    double area = 0.0;   // m²
    dvec3 low{0.0}, high{0.0};
    double border_length = 0.0; // m
    int winding_outside = 0;    // of the closed shells that it lies in: 0 for an outermost one

    /// Borders that are short for its size: open by accident, not by design. A hemisphere has 2π, a
    /// cube without one side 3.2, a ball of a thousand triangles without one of them 0.02.
    bool torn() const { return !closed && border_length * border_length < area; }
    /// Light cannot tell it from what surrounds it: it lies in the same body, and faces as that does.
    bool unseen() const { return closed && (sign > 0 ? winding_outside > 0 : winding_outside < 1); }
};

/// How the file's normals were made, as far as they tell.
enum class NormalKind {
    none,         // the file has none
    flat,         // those of the triangles
    max_weighted, // N. Max, J. Graphics Tools 4 (1999) 1: exact on a sphere, second order elsewhere
    area_weighted,
    angle_weighted, // these two are exact to first order only
    plain_mean,
    any_mean, // these cannot be told apart here, because the triangles are alike
    other     // of no such rule: those of the designer's surface, or of a coarse format
};

/// The file's normals against Max-1999 normals Σ (e₁×e₂) / (|e₁|²|e₂|²), the sum over the corners round a
/// vertex up to the nearest creases.
struct NormalHealth {
    NormalKind kind = NormalKind::none;
    std::uint64_t vertices = 0;       // compared
    double worst = 0.0, rms = 0.0;    // rad, where no crease is averaged over
    dvec3 worst_at{0.0};              //
    Found across_creases;             // vertices whose normal serves both sides of a crease
    double worst_across_crease = 0.0; // rad
    Found against;                    // vertices whose normal points to the other side of the surface
};

struct MeshHealth {
    static constexpr double crease_angle = 0.5235987755982988; // 30°, rad
    /// A triangle whose height is below this share of its longest side: angles below 0.6°. One
    /// coordinate's rounding turns its normal a hundred times as far as that of a well-shaped triangle.
    static constexpr double sliver_ratio = 0.01;

    std::uint64_t triangles = 0, places = 0; // positions
    double area = 0.0;                       // m²
    std::uint64_t borders = 0;
    std::vector<Border> longest_borders; // the first few, longest first
    double border_length = 0.0;          // m, of all
    Found crowded_edges;                 // of more than two triangles, or two that cannot be made to agree
    Found pinched_places;                // where parts touch at a point alone
    Found duplicates;                    // triangles with the corners of an earlier one
    Found slivers;
    double thinnest = 0.0; // m, the least height of a sliver
    std::uint64_t creases = 0;
    double crease_length = 0.0; // m
    std::vector<ShellHealth> shells;
    bool nesting_known = true;
    NormalHealth normals;
    std::optional<Found> self_intersections; // nothing: not looked for

    bool torn() const;
};

/// Linear in the triangles, but for nested shells, and for `look_for_intersections`, which gives up on
/// meshes too large or too tangled for a second's work.
MeshHealth health_of(Mesh const& mesh, bool look_for_intersections = false);

} // namespace sahl

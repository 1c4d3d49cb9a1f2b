// In: exact shapes and meshes with their places in the world, and a ray. Out: the crossings at the next place
// it meets. Two levels: the world finds objects, each object is met in its own frame, in double.
#pragma once

#include "geometry/mesh.h"
#include "geometry/shape.h"
#include "geometry/shell_set.h"
#include "math/ids.h"
#include "math/inline_vector.h"
#include "math/vec.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace sahl {

/// How a mesh stands for a curved surface, beyond its triangles and their corners' normals.
enum class Curving : std::uint8_t { none, quadratic, fitted, recognised };

struct PlacedGeometry {
    std::variant<Shape, std::shared_ptr<Mesh const>> geometry;
    Affine to_world;
    FaceId first_face;     // its faces have consecutive numbers from here
    ShellId first_shell;   // its shells too; an open shape has none
    bool detector = false; // met before whatever else lies at the same place
    bool interpolate =
        false;         // a mesh's normals are those of its vertices, weighted, not those of its triangles
    bool open = false; // a mesh as a surface without an inside; it has no shells
    Curving curving = Curving::none;
};

struct Crossing {
    double t = 0.0;
    FaceId face;
    ShellId shell; // of a closed geometry
    bool open = false;
    bool detector = false;
    bool enters = false;         // the volume that the shell encloses
    std::uint32_t object = 0;    // index of the placed geometry
    std::int32_t primitive = -1; // triangle
    dvec3 point{0.0};            // world, on the surface
    dvec3 normal{0.0};           // world, unit, out of the shell's volume; of an open shape: its +z
    dvec3 facet_normal{0.0};     // the same of the flat triangle, where the normal is interpolated
};

enum class Proof : std::uint8_t {
    clean,     // what was met fits what the ray was in
    recovered, // it does to within rounding: a face that the line just misses was taken as met
    leak,      // it does not: a shell that the ray is in is never left, or one that it is not in is met from
               // inside
};

/// An open geometry that lies where a ray starts, and the side of it that the ray is on: going away from it,
/// the ray does not meet it there, whatever rounding says.
struct LeftSheet {
    std::uint32_t object : 31;
    std::uint32_t above : 1; // on the side of its +z, of a mesh: of its normals
};
using LeftSheets = InlineVector<LeftSheet, 7>;

/// Crossings that coincide, in the order in which they count: detectors, other open surfaces, bodies. Empty:
/// nothing is met. After a leak `t` tells where the contradiction shows.
struct NextHit {
    InlineVector<Crossing, 8> at_one_place;
    LeftSheets
        beside; // sheets that are met within rounding of the place without coinciding, before they are met
    double t = 0.0;
    double blur = 0.0; // how far rounding may shift t
    Proof proof = Proof::clean;
    bool fits = true; // false: more coincides there than can be held, and what is held is not all
};

class MeshStore;
struct SeenAhead;

class Bvh {
  public:
    /// store   what is made of meshes comes from there, and stays there; none: it is this scene's alone
    explicit Bvh(std::vector<PlacedGeometry> geometries, MeshStore* store = nullptr);
    Bvh(Bvh&&) noexcept;
    Bvh& operator=(Bvh&&) noexcept;
    ~Bvh();

    /// The next place at t ≥ from.
    ///   direction   unit
    ///   inside      the shells that the ray is in
    ///   ahead       what look_ahead() saw of this line, if it was asked and `from` is 0: the answer is the
    ///               same, and comes sooner
    NextHit next(dvec3 const& origin, dvec3 const& direction, ShellSet const& inside, LeftSheets const& left,
                 double from = 0.0, SeenAhead const* ahead = nullptr) const;

    /// A ray that is asked about with others.
    struct Line {
        dvec3 const* origin;
        dvec3 const* direction;
        ShellSet const* inside;
    };
    static constexpr std::size_t most_together = 16;
    /// Of up to most_together rays that start close to each other and go much the same way, what a packet
    /// finds of the largest mesh.
    void look_ahead(std::span<Line const> lines, std::span<SeenAhead> seen) const;
    /// How large that mesh is (m, world); 0: there is none.
    double size_seen_ahead() const;
    /// The same of rays that go anywhere, one after another, where they are certain to ask about that mesh
    /// first of all; the others' places are left as they are.
    void look_ahead_in_turn(std::span<Line const> lines, std::span<SeenAhead* const> seen) const;
    /// Is there a mesh that rays may be asked about so?
    bool looks_ahead_in_turn() const;

    /// Of the sheets that a ray has left, those that still lie where it is now.
    LeftSheets still_there(LeftSheets const& left, dvec3 const& point) const;

    /// The shells that a ray starting there is in: an exact count of crossings. A start on a boundary belongs
    /// to the side that the ray heads for. `fits` is false where there are more than a ShellSet can hold.
    struct Start {
        ShellSet inside;
        LeftSheets on; // open geometries that the ray starts on
        bool fits = true;
    };
    Start start_at(dvec3 const& point, dvec3 const& direction) const;

    /// How the unit normal of a face turns from place to place: dn = turning · dx (1/m) for dx along the
    /// surface, in the world, by differences; zero where it is flat, at edges too.
    ///   object      index of the placed geometry
    ///   primitive   of a mesh
    ///   point       on the face; `normal` there, either way round, says which way round dn is
    dmat3 turning(std::uint32_t object, FaceId face, std::int32_t primitive, dvec3 const& point,
                  dvec3 const& normal) const;

    /// Pairs of faces that lie on each other, each once.
    std::vector<std::pair<FaceId, FaceId>> const& contacts() const;
    /// Faces of exact shapes that touch at one point (m, world).
    struct Tangency {
        FaceId one, other;
        dvec3 at;
    };
    std::vector<Tangency> const& tangencies() const;
    /// How a mesh is met: what was not recognised, or touches something, is fitted; an open one that touches
    /// something is not curved.
    Curving curving(std::uint32_t object) const;

    /// Meshes of float data whose vertices were moved onto what they touch, by no more than that data's
    /// rounding (m, world).
    struct MadeFlush {
        std::uint32_t object = 0;
        double farthest = 0.0;
    };
    std::vector<MadeFlush> const& made_flush() const;

    /// Two objects that overlap, or come near each other without touching.
    struct Closeness {
        std::uint32_t one = 0, other = 0;
        double overlap = 0.0; // m: the longest piece of a line found in both; 0: none
        dvec3 overlap_at{0.0};
        double gap = INFINITY; // m: the least found; ∞: none below what was asked for
        dvec3 gap_at{0.0};
        FaceId gap_one, gap_other; // between these
        // a curved face of a mesh follows one of the other object to within how far its facets may lie off
        // what they stand for: between the two are gaps and overlaps (m: the widest found); 0: none does, or
        // no gap is asked for
        double facets = 0.0;
        FaceId facets_one, facets_other;
    };
    /// What lines through the places where boxes meet find: overlaps, and gaps below `near` (m). A sample, at
    /// most 0.1 s of it: a small overlap may go unseen.
    std::vector<Closeness> closeness(double near) const;

    /// The box of all that is bounded, in the world.
    std::pair<dvec3, dvec3> bounds() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace sahl

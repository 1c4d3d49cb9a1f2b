// In: a mesh and a ray in the mesh's own frame. Out: the next crossing of one of its shells, in double.
// Embree proposes triangles in float; what is met is decided in double, watertight along shared edges, edges
// inclusive, so that no ray slips between two. Where that leaves a doubt all triangles are asked again as
// boxes in double.
#pragma once

#include "geometry/embree/box_tree.h"
#include "geometry/embree/triangle_tree.h"
#include "geometry/mesh.h"
#include "geometry/shell_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace sahl {

struct ShearedLine;
struct SeenTriangle;

struct MeshCrossing {
    double t = 0.0;
    double slope = 0.0;     // |n·d|
    double range = 0.0;     // of t over the triangle's corners
    double per_metre = 1.0; // t of a metre along the line's main axis
    dvec2 uv{0.0};          // weights of the triangle's second and third corner
    dvec3 normal{0.0};      // unit, out of the volume that the shell encloses
    std::uint32_t triangle = 0;
    bool enters = false;      // the volume that the shell encloses
    bool recovered = false;   // the line itself misses the triangle, by no more than rounding
    bool well_within = false; // it passes far from the border: rounding leaves its point in the triangle

    /// How far rounding (m, along the normal) may shift t: where the line runs along the triangle, over all
    /// of it.
    double blur(double rounding) const { return std::min(rounding / slope, range + rounding * per_metre); }
};

struct MeshAnswer {
    std::optional<MeshCrossing> crossing;
    /// t from which on what is met does not fit what the ray is said to be in: the mesh is not closed. ∞: it
    /// fits.
    double contradiction = INFINITY;
};

/// A line's next crossing of a mesh, found together with that of others.
struct SeenAhead {
    bool known = false; // false: a doubt is left, or it was not looked for
    std::optional<MeshCrossing> crossing;
};

/// Which of a mesh's shells a ray is in; the mesh's first shell has the number `first`.
struct InsideShells {
    ShellSet const& set;
    ShellId first;
    bool operator[](std::uint32_t shell) const { return set.contains({first.value + shell}); }
    bool any_of(std::size_t shells) const {
        return std::any_of(set.begin(), set.end(), [&](ShellId shell) {
            return shell.value >= first.value && shell.value - first.value < shells;
        });
    }
};

class MeshTree {
  public:
    explicit MeshTree(std::shared_ptr<Mesh const> mesh);

    /// The next crossing between `from` and `to` that fits the state: into a shell the ray is not in, out of
    /// one that it is in.
    ///   rounding   m: what lies within this of the ray's start, measured along the normal, is at the start
    /// At the start, and where a ray touches an edge, several crossings of one shell lie at one place; what
    /// they amount to follows from the next place, since crossings of a closed shell alternate.
    MeshAnswer next(dvec3 const& origin, dvec3 const& direction, InsideShells inside, Reach reach,
                    double rounding) const;

    /// Lines that go much the same way, from their starts on.
    struct Lines {
        TriangleTree::Lines lines;
        std::array<double, TriangleTree::most_together> rounding;
        std::array<ShellSet const*, TriangleTree::most_together> inside;
        ShellId first; // the mesh's first shell

        void add(dvec3 const& origin, dvec3 const& direction, double round, ShellSet const& in) {
            rounding[lines.count] = round;
            inside[lines.count] = &in;
            lines.add(origin, direction, length(direction));
        }
    };
    /// Of each the crossing that next() gives, where float leaves no doubt.
    void next_together(Lines const& asked, std::span<SeenAhead> seen) const;
    bool looks_ahead() const { return triangles_.visits_together(); }
    /// The same of lines that go anywhere, one after another: while one is looked for, what the last needs
    /// comes from memory.
    void next_in_turn(Lines const& asked, std::span<SeenAhead* const> seen) const;

    /// The same answer from every crossing that the line has, met as boxes in double: slower, and the judge
    /// of next().
    MeshAnswer next_exact(dvec3 const& origin, dvec3 const& direction, InsideShells inside, Reach reach,
                          double rounding) const;

    /// For each shell: does the ray run inside it just after its start?
    std::vector<bool> inside(dvec3 const& origin, dvec3 const& direction, double rounding) const;

    /// A face that a ray starts nearer to than float tells (`lift`, m), and comes to at a small slope, may go
    /// unproposed. That shows where the mesh is left again. May it have been entered so, and not be left
    /// before reach.to?
    bool may_hide(dvec3 const& origin, dvec3 const& direction, Reach reach, double lift) const;

    Mesh const& mesh() const { return *mesh_; }
    /// Anticlockwise seen from outside the volume that the shell encloses.
    std::array<dvec3, 3> const& corners(std::uint32_t triangle) const { return corners_[triangle].at; }
    /// Asks for a triangle's corners ahead of their use.
    void prefetch(std::uint32_t triangle) const {
        auto const* const from = reinterpret_cast<char const*>(&corners_[triangle]);
        __builtin_prefetch(from);
        __builtin_prefetch(from + sizeof(Corners) - 1);
    }
    /// The same of its vertices' normals, where it has them.
    void prefetch_normals(std::uint32_t triangle) const {
        if (!mesh_->soup.normals.empty())
            for (std::uint32_t const vertex : corners_[triangle].vertices)
                __builtin_prefetch(&mesh_->soup.normals[vertex]);
    }
    /// Of its corners, in the order of the mesh.
    std::array<std::uint32_t, 3> const& vertices(std::uint32_t triangle) const {
        return corners_[triangle].vertices;
    }
    /// Unit, out of the volume that the shell encloses.
    dvec3 normal(std::uint32_t triangle) const;
    /// The point of the triangle's plane below `point`; if it lies outside the triangle, where rounding may
    /// put it at grazing incidence, one of the border.
    dvec3 onto(std::uint32_t triangle, dvec3 const& point) const;
    /// The same where the point is well within the triangle, whose normal is known.
    dvec3 onto(std::uint32_t triangle, dvec3 const& normal, dvec3 const& point) const {
        return point - dot(normal, point - corners_[triangle].at[0]) * normal;
    }

  private:
    std::optional<MeshCrossing> meet(ShearedLine const& line, std::uint32_t triangle) const;
    MeshCrossing crossing_of(ShearedLine const& line, SeenTriangle const& seen, std::uint32_t triangle) const;
    std::vector<MeshCrossing> all(ShearedLine const& line, double from, double rounding) const;
    /// Where a line contradicts what the ray is in: the nearest triangle that fits and that the line misses
    /// by no more than rounding. Reflected close to an edge, a ray may start beyond the face on its other
    /// side.
    std::optional<MeshCrossing> just_missed(ShearedLine const& line, std::uint32_t shell, bool inside,
                                            Reach reach, double rounding) const;

    BoxTree const& boxes() const;
    /// All that a hit needs of a triangle, at one place in memory: a ray meets any of them next, and pays for
    /// each place that it looks at.
    struct alignas(32) Corners {
        std::array<dvec3, 3> at;               // anticlockwise seen from outside
        std::array<std::uint32_t, 3> vertices; // in the mesh's order
    };
    static std::vector<Corners> outward(Mesh const& mesh);
    std::vector<std::array<dvec3, 3>> all_corners() const;

    std::shared_ptr<Mesh const> mesh_;
    std::vector<Corners> corners_;
    TriangleTree triangles_;
    mutable std::once_flag boxes_built_;
    mutable std::optional<BoxTree> boxes_; // built on first need
};

} // namespace sahl

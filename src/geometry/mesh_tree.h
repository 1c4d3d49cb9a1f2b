// In: a mesh and a ray in the mesh's own frame. Out: the next crossing of one of its shells, in double.
// Triangles are double user geometry: watertight along shared edges, edges inclusive, so that no ray slips
// between two.
#pragma once

#include "geometry/embree/box_tree.h"
#include "geometry/mesh.h"
#include "geometry/shell_set.h"

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

namespace sahl {

struct MeshCrossing {
    double t = 0.0;
    double slope = 0.0; // |n·d|
    dvec2 uv{0.0};      // weights of the triangle's second and third corner
    std::uint32_t triangle = 0;
    bool enters = false; // the volume that the shell encloses
};

struct MeshAnswer {
    std::optional<MeshCrossing> crossing;
    /// t from which on what is met does not fit what the ray is said to be in: the mesh is not closed. ∞: it
    /// fits.
    double contradiction = INFINITY;
};

/// Which of a mesh's shells a ray is in; the mesh's first shell has the number `first`.
struct InsideShells {
    ShellSet const& set;
    ShellId first;
    bool operator[](std::uint32_t shell) const { return set.contains({first.value + shell}); }
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

    /// For each shell: does the ray run inside it just after its start?
    std::vector<bool> inside(dvec3 const& origin, dvec3 const& direction, double rounding) const;

    Mesh const& mesh() const { return *mesh_; }
    /// Unit, out of the volume that the shell encloses.
    dvec3 normal(std::uint32_t triangle) const;

  private:
    struct Line;
    std::optional<MeshCrossing> meet(Line const& line, std::uint32_t triangle) const;
    std::vector<MeshCrossing> all(dvec3 const& origin, dvec3 const& direction, double from,
                                  double rounding) const;
    MeshAnswer settle(std::vector<MeshCrossing> crossings, InsideShells inside, Reach reach,
                      double rounding) const;

    std::shared_ptr<Mesh const> mesh_;
    BoxTree tree_;
};

} // namespace sahl

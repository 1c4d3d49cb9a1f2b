// In: a mesh and a seed. Out: how many of the next hits on walks through it differ between the fast way and
// the exact one. The walks start anywhere, at vertices and on edges, and go on by mirror or by Snell's law,
// from hit to hit.
#pragma once

#include "geometry/mesh_tree.h"
#include "optics/snell.h"
#include "support/dice.h"

#include <limits>
#include <memory>
#include <utility>

namespace sahl::bench {

struct WalkCount {
    std::uint64_t asked = 0, hits = 0, different = 0, contradictions = 0;
    dvec3 origin{0.0}, direction{0.0}; // of the last that differed
};

class MeshWalk {
  public:
    MeshWalk(MeshTree const& tree, std::uint64_t seed)
        : tree_(tree), dice_(seed), size_(length(tree.mesh().high - tree.mesh().low)) {}

    /// One walk of at most `steps` hits.
    void walk(int steps, WalkCount& count) {
        Mesh const& mesh = tree_.mesh();
        double const kind = dice_.uniform();
        dvec3 const target = kind < 0.25  ? a_vertex()
                             : kind < 0.6 ? on_an_edge()
                                          : dice_.in_box(mesh.low, mesh.high);
        bool const along = kind < 0.15 || (kind >= 0.25 && kind < 0.4);
        dvec3 direction = along ? grazing() : dice_.direction();
        dvec3 origin = target - size_ * dice_.between(1.05, 2.0) * direction; // outside
        ShellSet inside;
        for (int step = 0; step < steps; ++step) {
            double const rounding =
                64.0 * std::numeric_limits<double>::epsilon() * (size_ + length(origin) + length(mesh.low));
            InsideShells const in{inside, {0}};
            Reach const all{0.0, INFINITY};
            MeshAnswer const fast = tree_.next(origin, direction, in, all, rounding);
            MeshAnswer const exact = tree_.next_exact(origin, direction, in, all, rounding);
            ++count.asked;
            if (!same(fast, exact)) {
                ++count.different;
                count.origin = origin;
                count.direction = direction;
            }
            count.contradictions += exact.contradiction < INFINITY;
            if (!exact.crossing || exact.contradiction < INFINITY)
                return;
            ++count.hits;
            MeshCrossing const& c = *exact.crossing;
            origin = tree_.onto(c.triangle, origin + c.t * direction);
            dvec3 const outward = tree_.normal(c.triangle);
            dvec3 const facing = dot(outward, direction) > 0.0 ? -outward : outward;
            double const n1 = c.enters ? 1.0 : 1.5, n2 = c.enters ? 1.5 : 1.0;
            auto const through = refract(direction, facing, n1, n2);
            bool const crosses = through && dice_.uniform() < (c.enters ? 0.8 : 0.4);
            direction = crosses ? *through : reflect(direction, facing);
            if (!crosses)
                continue;
            ShellId const shell{mesh.triangle_shell[c.triangle]};
            if (c.enters)
                inside.insert(shell);
            else
                inside.erase(shell);
        }
    }

  private:
    static bool same(MeshAnswer const& a, MeshAnswer const& b) {
        if (a.crossing.has_value() != b.crossing.has_value() || a.contradiction != b.contradiction)
            return false;
        return !a.crossing || (a.crossing->triangle == b.crossing->triangle &&
                               a.crossing->t == b.crossing->t && a.crossing->enters == b.crossing->enters);
    }
    std::array<std::uint32_t, 3> a_triangle() {
        auto const& triangles = tree_.mesh().soup.triangles;
        last_ = static_cast<std::uint32_t>(dice_.below(triangles.size()));
        return triangles[last_];
    }
    /// Along the triangle that the target is of, but for 1e-7 to 1e-1.
    dvec3 grazing() {
        dvec3 const normal = tree_.normal(last_);
        return normalize(perpendicular_to(normal, dice_.direction()) +
                         dice_.sign() * dice_.log_between(1e-7, 1e-1) * normal);
    }
    dvec3 a_vertex() { return tree_.mesh().soup.positions[a_triangle()[0]]; }
    dvec3 on_an_edge() {
        auto const t = a_triangle();
        auto const& p = tree_.mesh().soup.positions;
        return glm::mix(p[t[0]], p[t[1]], dice_.uniform() < 0.5 ? 0.5 : dice_.uniform());
    }

    MeshTree const& tree_;
    Dice dice_;
    double size_;
    std::uint32_t last_ = 0; // triangle that was chosen last
};

} // namespace sahl::bench

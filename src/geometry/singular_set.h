// In: a quadric. Out: where it has no tangent plane.
#pragma once

#include "geometry/quadric.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sahl {

/// A symmetric matrix's inverse where it has one, and 0 along its null space (Jacobi's rotations).
inline dmat3 pseudo_inverse(dmat3 a) {
    dmat3 vectors(1.0);
    for (int sweep = 0; sweep < 30; ++sweep)
        for (auto const& [p, q] : {std::pair(0, 1), {0, 2}, {1, 2}}) {
            if (a[p][q] == 0.0)
                continue;
            double const theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
            double const t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
            double const c = 1.0 / std::hypot(t, 1.0), s = t * c;
            dmat3 turn(1.0);
            turn[p][p] = turn[q][q] = c;
            turn[q][p] = s;
            turn[p][q] = -s;
            a = glm::transpose(turn) * a * turn;
            vectors = vectors * turn;
        }
    double const largest = std::max({std::abs(a[0][0]), std::abs(a[1][1]), std::abs(a[2][2])});
    dmat3 inverse(0.0);
    for (int i = 0; i < 3; ++i)
        if (std::abs(a[i][i]) > 1e-12 * largest) // rounding of coefficients is far below
            inverse += (1.0 / a[i][i]) * glm::outerProduct(vectors[i], vectors[i]);
    return inverse;
}

/// Where a quadric has no tangent plane: a cone's apex, the line that two planes share, a plane that counts
/// twice.
class SingularSet {
  public:
    SingularSet(Quadric const& quadric, double size)
        : quadric_(quadric), inverse_(pseudo_inverse(quadric.a)) {
        dvec3 const p = nearest(dvec3(0.0));
        // what the quadric is worth at a distance `size` along its steepest way, but for rounding
        double const worth =
            std::abs(quadric.c) + size * length(quadric.b) +
            size * size * (length(quadric.a[0]) + length(quadric.a[1]) + length(quadric.a[2]));
        exists_ = std::abs(quadric.value(p)) <= 1e-13 * worth &&
                  length(quadric.gradient(p)) <= 1e-13 * worth / size;
    }
    bool exists() const { return exists_; }
    dvec3 nearest(dvec3 const& p) const { return p - 0.5 * (inverse_ * quadric_.gradient(p)); }

  private:
    Quadric const& quadric_;
    dmat3 inverse_;
    bool exists_ = false;
};

} // namespace sahl

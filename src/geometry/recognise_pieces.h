// In: the places and normals of one smooth piece of a mesh. Out: the plane, sphere, cylinder or other conic
// of revolution that it is, if it is one. Shared by recognise.cpp and the fits alone.
#pragma once

#include "geometry/quadric.h"
#include "geometry/solid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace sahl {

/// Of one smooth piece.
struct Piece {
    std::vector<dvec3> places, normals; // out of the body
    std::uint32_t face = 0;
    bool one_face = true;
    dvec3 centre{0.0};
};

struct FoundPiece {
    Region region;
    std::optional<Quadric> quadric;
    std::optional<Region> behind; // of a hollow sphere: the side of its centre that the body is on
};

/// The float's ulp at x over that at `reach`, but no less than an eighth: what is small may have been
/// computed by what is large.
inline double ulp_share(double x, double reach) {
    return std::clamp(std::exp2(std::floor(std::log2(std::abs(x))) - std::floor(std::log2(reach))), 0.125,
                      1.0);
}

/// Holds a piece to be what is fitted to it, or not, and remembers by how much it was off.
struct PieceJudge {
    double tolerance; // m
    bool normals;     // do they count
    double reach;     // m, the largest coordinate
    bool floats;      // are the places floats
    double residual = 0.0, normals_off = 0.0;

    /// How far each coordinate of a place may be rounded, as a share of the ulp at the reach.
    dvec3 steps(dvec3 const& p) const {
        return floats ? dvec3(ulp_share(p.x, reach), ulp_share(p.y, reach), ulp_share(p.z, reach))
                      : dvec3(1.0);
    }
};

inline constexpr double normals_agree = 1e-6; // rad: float normals are off by a tenth of it

template <class Distance, class NormalAt>
bool accepts(PieceJudge& judge, Piece const& piece, Distance const& distance, NormalAt const& normal_at) {
    double off = 0.0, turned = 0.0;
    for (dvec3 const& p : piece.places)
        off = std::max(off, std::abs(distance(p)));
    for (std::size_t i = 0; judge.normals && i < piece.places.size(); ++i) {
        dvec3 const n = normal_at(piece.places[i]);
        if (dot(n, n) == 0.0) // an apex has none
            continue;
        turned = std::max(turned, length(piece.normals[i] - (dot(n, piece.normals[i]) < 0.0 ? -n : n)));
    }
    if (!(off <= judge.tolerance) || !(turned <= normals_agree))
        return false;
    judge.residual = std::max(judge.residual, off);
    judge.normals_off = std::max(judge.normals_off, turned);
    return true;
}

/// Each in turn, the simplest first; nothing where it is none of them.
std::optional<FoundPiece> fit_piece(Piece const& piece, PieceJudge& judge);

/// Of a piece that is a conic about an axis: ρ² = c₀ + c₁ z + c₂ z², a cone, paraboloid, ellipsoid or
/// hyperboloid.
std::optional<FoundPiece> as_revolved(Piece const& piece, PieceJudge& judge);

} // namespace sahl

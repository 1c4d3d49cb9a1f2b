#include "geometry/mesh_query.h"

#include "geometry/triangle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sahl {

namespace {

/// A line that passes an edge within so many roundings may meet both its triangles at one place, though
/// Embree does not propose the one that it meets at a slope of down to their inverse.
constexpr double edge_roundings = 1e5;

/// t of the nearest corner.
double nearest_corner(dvec3 const& origin, dvec3 const& direction, TriangleCorners const& corners) {
    auto const t_of = [&](dvec3 const& p) { return dot(direction, p - origin); };
    return std::min({t_of(corners[0]), t_of(corners[1]), t_of(corners[2])}) / dot(direction, direction);
}

bool share_a_corner(MeshTree const& tree, std::uint32_t one, std::uint32_t other) {
    if (tree.mesh().shell_of(one) != tree.mesh().shell_of(other))
        return false;
    auto const a = tree.corners(one), b = tree.corners(other);
    return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

enum class Passes : std::uint8_t { within, beside, close }; // close to the border, on either side

/// Where the line passes the triangle, seen no closer to its border than `border` (m); `crossing` is written
/// where it passes within.
inline Passes meet_plainly(MeshTree const& tree, dvec3 const& origin, dvec3 const& direction, double unit,
                           std::uint32_t triangle, double border, MeshCrossing& crossing) {
    // T. Möller, B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, J. Graphics Tools 2 (1997) 21
    auto const [a, b, c] = tree.corners(triangle);
    dvec3 const ab = b - a, ac = c - a, to_a = a - origin;
    dvec3 const normal = precise_cross(ab, ac), moment = cross(to_a, direction);
    double const along = dot(normal, direction), sense = along < 0.0 ? -1.0 : 1.0;
    double const v = sense * dot(moment, ac), w = -sense * dot(moment, ab), u = sense * along - v - w;
    double const squared = border * border * unit * unit;
    auto const far = [&](double area, dvec3 const& edge) { return area * area > squared * dot(edge, edge); };
    if (!(u > 0.0 && v > 0.0 && w > 0.0 && far(u, c - b) && far(v, ac) && far(w, ab))) {
        bool const beside = (u < 0.0 && far(u, c - b)) || (v < 0.0 && far(v, ac)) || (w < 0.0 && far(w, ab));
        return beside ? Passes::beside : Passes::close;
    }
    double const by_length = 1.0 / length(normal);
    crossing.t = dot(normal, to_a) / along;
    crossing.slope = std::abs(along) * by_length;
    crossing.range = INFINITY;
    crossing.well_within = true;
    bool const turned = tree.mesh().shells[tree.mesh().shell_of(triangle)].sign < 0;
    crossing.uv = sense / along * (turned ? dvec2(w, v) : dvec2(v, w));
    crossing.triangle = triangle;
    crossing.enters = along < 0.0;
    crossing.normal = by_length * normal;
    return Passes::within;
}

} // namespace

bool MeshQuery::settle(double looked_to, std::optional<MeshCrossing>& crossing) const {
    MeshCrossing best;
    best.t = INFINITY;
    bool doubtful = too_many_; // at last: something but plain crossings lies at the start
    double doubt = INFINITY;   // t where a triangle is grazed, or its border passed closely
    std::uint32_t missed = 0;  // a bit for each proposal that the line clearly misses
    for (std::size_t i = 0; i < proposals_.size(); ++i) {
        Proposal const& proposal = proposals_[i];
        std::uint32_t const triangle = proposal.triangle;
        if (proposal.sense == 0) {
            doubt = std::min(doubt, nearest_corner(origin_, direction_, tree_.corners(triangle)));
            continue;
        }
        MeshCrossing plain;
        Passes const passes =
            meet_plainly(tree_, origin_, direction_, unit_, triangle, edge_roundings * rounding_, plain);
        if (passes == Passes::beside) { // grown over the line
            missed |= 1u << i;
            continue;
        }
        if (passes == Passes::close || plain.enters != (proposal.sense < 0)) {
            doubt = std::min(doubt, proposal.t - blur_);
            continue;
        }
        double const distance = (plain.t - from_) * plain.slope;
        if (distance <= rounding_) // at the start, or behind it
            doubtful = doubtful || distance >= -rounding_;
        else if (std::pair(plain.t, plain.triangle) < std::pair(best.t, best.triangle))
            best = plain;
    }
    if (best.t < INFINITY)
        tree_.prefetch_normals(best.triangle); // for whoever interpolates
    // a neighbour of theirs is met there; where it is not, something may be that float does not see
    for (std::size_t i = 0; missed >> i; ++i) {
        Proposal const& proposal = proposals_[i];
        if (missed >> i & 1u &&
            (proposal.t + 2.0 * blur_ < best.t || !share_a_corner(tree_, proposal.triangle, best.triangle)))
            doubt = std::min(doubt, proposal.t - blur_);
    }
    bool const nothing = best.t == INFINITY;
    double const first_doubt = std::min(unfit_, doubt);
    doubtful =
        doubtful || (nothing ? (in_some_ && looked_to == INFINITY) || first_doubt < looked_to
                             : std::min(first_doubt, looked_to) <= best.t + 2.0 * best.blur(rounding_));
    if (in_some_ &&
        !tree_.mesh().closed()) // through a hole another shell may be met than the one that was left
        for (std::uint32_t shell = 0; shell < shells_; ++shell)
            doubtful = doubtful || (inside_[shell] && tree_.mesh().shell_of(best.triangle) != shell);
    if (doubtful)
        return false;
    if (nothing)
        crossing.reset();
    else
        crossing = best;
    return true;
}

} // namespace sahl

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

/// Where the line passes the triangle no closer to its border than that (m); otherwise it may or may not.
inline std::optional<MeshCrossing> meet_plainly(MeshTree const& tree, dvec3 const& origin,
                                                dvec3 const& direction, double unit, std::uint32_t triangle,
                                                double border) {
    // T. Möller, B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, J. Graphics Tools 2 (1997) 21
    auto const [a, b, c] = tree.corners(triangle);
    dvec3 const ab = b - a, ac = c - a, to_a = a - origin;
    dvec3 const normal = precise_cross(ab, ac), moment = cross(to_a, direction);
    double const along = dot(normal, direction), sense = along < 0.0 ? -1.0 : 1.0;
    double const v = sense * dot(moment, ac), w = -sense * dot(moment, ab), u = sense * along - v - w;
    auto const within = [&, squared = border * border * unit * unit](double area, dvec3 const& edge) {
        return area > 0.0 && area * area > squared * dot(edge, edge);
    };
    if (!(within(u, c - b) && within(v, ac) && within(w, ab)))
        return std::nullopt;
    MeshCrossing crossing;
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
    return crossing;
}

} // namespace

bool MeshQuery::settle(double looked_to, MeshAnswer& answer) const {
    MeshCrossing best;
    best.t = INFINITY;
    bool doubtful = too_many_; // at last: something but plain crossings lies at the start
    double doubt = INFINITY;   // t where a triangle is grazed, or its border passed closely
    for (Proposal const& proposal : proposals_) {
        std::uint32_t const triangle = proposal.triangle;
        if (proposal.sense == 0) {
            doubt = std::min(doubt, nearest_corner(origin_, direction_, tree_.corners(triangle)));
            continue;
        }
        auto const plain =
            meet_plainly(tree_, origin_, direction_, unit_, triangle, edge_roundings * rounding_);
        if (!plain || plain->enters != (proposal.sense < 0)) {
            doubt = std::min(doubt, proposal.t - blur_);
            continue;
        }
        double const distance = (plain->t - from_) * plain->slope;
        if (distance <= rounding_) // at the start, or behind it
            doubtful = doubtful || distance >= -rounding_;
        else if (std::pair(plain->t, plain->triangle) < std::pair(best.t, best.triangle))
            best = *plain;
    }
    bool const nothing = best.t == INFINITY;
    double const first_doubt = std::min(unfit_, doubt);
    doubtful = doubtful || (nothing ? (in_some_ && looked_to == INFINITY) || first_doubt < looked_to
                                    : first_doubt <= best.t + 2.0 * best.blur(rounding_));
    if (in_some_ &&
        !tree_.mesh().closed()) // through a hole another shell may be met than the one that was left
        for (std::uint32_t shell = 0; shell < shells_; ++shell)
            doubtful = doubtful || (inside_[shell] && tree_.mesh().shell_of(best.triangle) != shell);
    if (doubtful)
        return false;
    if (!nothing)
        answer.crossing = best;
    return true;
}

} // namespace sahl

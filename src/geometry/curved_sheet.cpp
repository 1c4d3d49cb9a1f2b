#include "geometry/curved_sheet.h"

#include "geometry/mesh_sheet.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sahl {

namespace {

/// Weights: cells overlap by so much, so that rounding leaves nothing between them.
constexpr double overlap_of_cells = 1e-10;

} // namespace

std::optional<CurvedCrossing> CurvedSheet::next(dvec3 const& origin, dvec3 const& direction, Reach reach,
                                                double rounding, std::optional<bool> above) const {
    std::optional<CurvedCrossing> best;
    AheadOnSheet const ahead{reach, rounding, above};
    double const start = ahead.start(direction);
    CurvedTree::Care const care{false, overlap_of_cells, rounding};
    patches_.boxes_->visit(origin, direction, {start, reach.to}, [&](std::uint32_t triangle, double to) {
        for (bool const rises : {false, true}) {
            auto const c = patches_.meet(triangle, origin, direction, rises, start, care);
            if (!c || c->t > to || !ahead.holds(c->t, c->slope, c->enters))
                continue;
            if (!best || std::pair(c->t, triangle) < std::pair(best->t, best->triangle))
                best = c;
            to = std::min(to, best->t);
        }
        return to;
    });
    return best;
}

std::optional<bool> CurvedSheet::heads_above(dvec3 const& point, dvec3 const& direction,
                                             double rounding) const {
    std::optional<bool> answer;
    double nearest = rounding;
    // a short line through the point, long enough for every box that comes within rounding of it
    dvec3 const along(1.0, 0.0, 0.0);
    patches_.boxes_->visit(point, along, {-2.0 * rounding, 2.0 * rounding},
                           [&](std::uint32_t triangle, double to) {
                               if (auto const foot = patches_.foot(triangle, point))
                                   if (double const off = length(foot->point - point); off <= nearest) {
                                       nearest = off;
                                       answer = dot(foot->geometric, direction) > 0.0;
                                   }
                               return to;
                           });
    return answer;
}

} // namespace sahl

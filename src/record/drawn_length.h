// In: a ray log. Out: how long what escapes is drawn.
#pragma once

#include "record/read_rays.h"

#include <algorithm>
#include <cmath>

namespace sahl {

/// A quarter of the diagonal of the box round all places where pieces begin and end; 1 cm where that is none.
inline double drawn_escape(RayLogReader const& log, PathFilter const* where) {
    dvec3 low(INFINITY), high(-INFINITY);
    read_rays(log, where, [&](std::span<Segment const> ray) {
        for (Segment const& segment : ray) {
            dvec3 const end = std::isfinite(segment.length)
                                  ? segment.origin + segment.length * segment.direction
                                  : segment.origin;
            low = glm::min(low, glm::min(segment.origin, end));
            high = glm::max(high, glm::max(segment.origin, end));
        }
        return true;
    });
    double const diagonal = length(high - low);
    return std::isfinite(diagonal) && diagonal > 0.0 ? 0.25 * diagonal : 1e-2;
}

inline dvec3 drawn_end(Segment const& segment, double escape) {
    return segment.origin + (std::isfinite(segment.length) ? segment.length : escape) * segment.direction;
}

} // namespace sahl

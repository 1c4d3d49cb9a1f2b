// In: objects in their places. Out: where two of them overlap, or come nearer than a given distance without
// touching, found by lines through the places where their boxes meet.
#pragma once

#include "geometry/touching.h"

#include <span>
#include <vector>

namespace sahl {

/// Only what is nearer than `near` (m) counts as a gap; 0: overlaps alone. What lies between the lines is not
/// seen, though from the nearest one that they find a search goes on to the least gap.
std::vector<Bvh::Closeness> survey(std::span<Placed const> objects, Touching const& touch, double near);

} // namespace sahl

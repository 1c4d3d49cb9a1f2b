// In: the corners of a polygon. Out: triangles that fill it, concave or not.
#pragma once

#include "math/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sahl {

/// Adds size − 2 triangles of the polygon's corners (numbers from 0), each turned as the polygon is; none is
/// without area where that can be helped. The corners need not lie in one plane: their projection along
/// their mean normal (Newell's) is what is filled. By cutting ears (Meisters 1975); about linear in the
/// number of corners, since those that can spoil an ear are sought in a grid.
///   patience   how many corners may be looked at in that grid, in all calls together: what is used is taken
///              off. An outline made to be slow would take the square of its corners.
/// Returns false where the outline crosses itself, or patience is at an end: triangles may then overlap, but
/// their border is the outline. At least three corners, fewer than 2³².
bool cut_polygon(std::span<dvec3 const> corners, std::vector<std::array<std::uint32_t, 3>>& triangles,
                 std::uint64_t& patience);

} // namespace sahl

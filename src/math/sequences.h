// In: how many points are wanted. Out: where they lie, for beams, pixels and pilots; the same points in every
// run. All points of a pattern stand for equal areas; disks are unit disks about the origin.
#pragma once

#include "math/vec.h"

#include <cstdint>
#include <vector>

namespace sahl {

/// Point `index` of the scrambled Sobol sequence in [0, 1)²: every 2^m points from a multiple of 2^m on have
/// one point in each of the 2^m boxes of every way to halve the square m times. Direction numbers: S. Joe and
/// F. Y. Kuo, SIAM J. Sci. Comput. 30 (2008) 2635, first two dimensions; scrambling: B. Burley, J. Comput.
/// Graph. Tech. 9 (2020) 4. Another seed gives another sequence. Coordinates are multiples of 2⁻³².
dvec2 sobol_2d(std::uint32_t index, std::uint64_t seed);

/// The area-preserving map from [0, 1]² to the unit disk that keeps neighbours together and sends the centre
/// to the centre (P. Shirley and K. Chiu, J. Graphics Tools 2 (1997) 3, 45).
dvec2 disk_from_square(dvec2 const& square);

/// The centres, within the unit disk, of the n × n equal cells of the square around it, for the smallest n
/// that gives at least `at_least` points (0 counts as 1); symmetric about both axes. The excess is below
/// 3√at_least.
std::vector<dvec2> square_grid_in_disk(std::uint64_t at_least);

/// The centres of equal cells that fill a rectangle of `size` (≥ 0) about the origin, the cells as nearly
/// square as their number allows; a side of 0 makes a line. The excess is below one row.
std::vector<dvec2> square_grid_in_rectangle(std::uint64_t at_least, dvec2 const& size);

/// The triangular lattice with a point at the centre: whole shells of equal distance until there are at least
/// `at_least` points, spaced so that they share the disk's area. The excess is below one shell: 6 or 12
/// points, seldom 24 or 48.
std::vector<dvec2> hexagonal_in_disk(std::uint64_t at_least);

/// Rows of equal length, alternately a quarter of a step to the left and to the right, an even number of
/// them, so that the centroid is the centre and all cells lie within the rectangle. The excess is below one
/// column.
std::vector<dvec2> hexagonal_in_rectangle(std::uint64_t at_least, dvec2 const& size);

/// `count` points at equal steps on the unit circle, the first on the x axis.
std::vector<dvec2> ring(std::uint64_t count);

/// `count` points at equal steps along the outline of a rectangle of `size` (≥ 0, not both 0) about the
/// origin, in units of its sides, the first in the middle of the right side, on counter-clockwise.
std::vector<dvec2> edge_of_rectangle(std::uint64_t count, dvec2 const& size);

/// `count` points at equal steps from −1 to 1 on the y axis, both ends included; an odd count includes 0, one
/// is 0.
std::vector<dvec2> fan(std::uint64_t count);

} // namespace sahl

// In: the rows of one ray, as logged. Out: who begot whom, and what the directions tell of the boundaries
// between: normals and media that the log does not write down.
#pragma once

#include "record/ray_log.h"

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <vector>

namespace sahl {

/// Rows are told by their position in `rows`. Both references must outlive the tree.
struct RayTree {
    LogHeader const& header;
    std::vector<Segment> const& rows;
    std::vector<std::vector<std::size_t>> children{}; // of each row, in the order of the log
    std::vector<std::optional<std::size_t>>
        parents{};     // none: the root, or a row whose parent is not in the log
    bool whole = true; // no row is missing that the others tell of, nor was any left out for its power
};

/// `rows` are those of one ray in the order of the log; some may be missing.
RayTree grow_tree(LogHeader const& header, std::vector<Segment> const& rows);

/// The first child of a row that was born by one of these events, or null.
Segment const* child_born(RayTree const& tree, std::size_t row, std::initializer_list<Event> events);

/// Index of a medium at a wavelength in metres; none if the log's tables do not have it.
std::optional<double> index_of(LogHeader const& header, std::size_t medium, double wavelength);

/// A unit vector along the normal where a row ends, of either sign, from the branch that tells it best:
///   N ∥ d₁ − d₂ under reflection, N ∥ n₁d₁ − n₂d₂ under refraction
/// None if no branch tells it, as where the indices are the same.
std::optional<dvec3> normal_at_end(RayTree const& tree, std::size_t row);

struct Behind {
    std::size_t medium;
    double critical_angle; // rad
    bool seen; // the tree shows it; otherwise it is taken to be where the ray came into its medium from
};

/// What lies beyond the total reflection that ends a row, at this angle of incidence in radians: the medium
/// that another row meets across the same surface, else the one that the ray was in before it entered this
/// one. None if neither would reflect all.
std::optional<Behind> beyond(RayTree const& tree, std::size_t row, double incidence);

/// The angle between a direction and the line along `normal`, both unit, in [0, π/2], precise near both ends.
double angle_to(dvec3 const& direction, dvec3 const& normal);

} // namespace sahl

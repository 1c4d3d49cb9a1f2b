// In: the tree of one ray, as logged. Out: the tree as text, with the reason for every split and every end.
#pragma once

#include "record/ray_log.h"

#include <map>
#include <string>
#include <vector>

namespace sahl {

/// Draws the tree, one entry a segment: how it was born, the medium, length, optical path and power, then why
/// it ended. Branches are indented with ├─ and └─; an only child goes on in its parent's column.
///   rows   those of one ray in the order of the log; rows that are missing are said to be so, none at all
///   give ""
///   drawn   by row: whether it is drawn; null: all. Rows that are not still tell of the boundaries they meet
///   normals   of flat surfaces, by name: unit vectors, of either sign
/// The log has no normals. At a boundary they follow from the directions: N ∥ n₁d₁ − n₂d₂ under refraction,
/// N ∥ d₁ − d₂ under reflection; the medium behind a total reflection is inferred, see `beyond` in
/// explain.cpp.
std::string explain_ray(LogHeader const& header, std::vector<Segment> const& rows,
                        std::vector<char> const* drawn = nullptr,
                        std::map<std::string, dvec3> const& normals = {});

} // namespace sahl

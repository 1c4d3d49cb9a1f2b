// In: a mesh that stands for a curved surface. Out: one of more triangles, nearer to that surface.
#pragma once

#include "geometry/mesh.h"

#include <memory>
#include <optional>

namespace sahl {

/// Halves sides of triangles until no side's middle and no triangle's lies farther than `tolerance` (m in the
/// mesh's frame) from where fitted patches (curved_tree.h) have it. Vertices stay, and new ones take place
/// and normal from the patches; neighbours halve the side that they share alike, so that what is closed stays
/// so. Sides along creases and borders are chords.
/// Nothing where the mesh has no normals, so that its facets are what is meant, or edges that more than two
/// triangles share; nor where it would take more than `most` triangles.
std::optional<Mesh> subdivided(std::shared_ptr<Mesh const> const& mesh, double tolerance,
                               std::size_t most = 20'000'000);

} // namespace sahl

// In: triangles and how they hang together. Out: the closed components, their volumes, which of them lie
// inside out.
#pragma once

#include "geometry/mesh_shadow.h"
#include "geometry/mesh_topology.h"
#include "math/vec.h"

#include <optional>
#include <span>
#include <vector>

namespace sahl {

/// Its triangles as corners at places; none where the component is open.
struct ClosedComponent {
    std::vector<Corners> triangles;
    dvec3 low{0.0}, high{0.0};
    double signed_volume = 0.0;   // m³; > 0: normals point outwards
    std::optional<Shadow> shadow; // made when something may be inside
};

/// One for each component of the topology.
std::vector<ClosedComponent> closed_components(std::span<Corners const> corners, Topology const& topology,
                                               std::span<dvec3 const> places);

/// Which components lie inside out and are inside no other.
std::vector<bool> outermost_inside_out(std::vector<ClosedComponent>& components,
                                       std::span<dvec3 const> places);

} // namespace sahl

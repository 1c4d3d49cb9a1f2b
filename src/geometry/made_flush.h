// In: objects in their places, and which triangles lie on each other but for the rounding of float data. Out:
// meshes whose vertices were moved by no more than that, so that in double they lie on each other.
#pragma once

#include "geometry/mesh_contact.h"
#include "geometry/placed.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sahl {

/// Triangle `fit.one` of object `one` lies on triangle (of a shape: face) `fit.other` of object `other`.
struct PlacedFit {
    std::uint32_t one = 0, other = 0;
    TriangleFit fit;
};

struct FlushMesh {
    std::uint32_t object = 0;
    std::shared_ptr<Mesh const> mesh;
    double farthest = 0.0; // m, world: how far a vertex was moved
};

/// Vertices that are one become one, and quads between them are cut along the same diagonal; a vertex of
/// triangles that lie on a plane is put on it, on the exact shape's where there is one. All fits of the scene
/// are needed, exact ones too: a vertex keeps to all the planes that it lies on.
std::vector<FlushMesh> made_flush(std::span<Placed const> objects, std::span<PlacedFit const> fits);

} // namespace sahl

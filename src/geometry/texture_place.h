// In: points of surfaces, in their object's own frame. Out: where on a picture they lie.
#pragma once

#include "geometry/mesh.h"
#include "geometry/shape.h"

#include <optional>

namespace sahl {

/// A place on a picture, from the left and from the bottom, 0 to 1 once over it, and how it moves with the
/// point.
struct TexturePlace {
    dvec2 uv{0.0};
    dvec3 across{0.0}, up{0.0}; // gradients of u and v, 1/m

    /// By how much it moves when the point moves by `step`.
    dvec2 moved(dvec3 const& step) const { return {dot(across, step), dot(up, step)}; }
};

/// Linear between the corners; none where the mesh has no coordinates.
std::optional<TexturePlace> texture_place(Mesh const& mesh, std::uint32_t triangle, dvec3 const& point);

/// On the surface of an exact shape. Round a sphere, a cylinder or a cone the picture lies once, its upper
/// side toward +z; on what is flat, or nearly, it lies upright (+y, or −z seen from above) as seen from
/// outside, once over the shape's width and height, its centre at the shape's origin. A plane has a metre of
/// it.
///   face     of the shape; normal   there, outward (of an open shape +z), of any length
///   size     m, of one repetition where it is flat; none: as said
TexturePlace texture_place(Shape const& shape, std::size_t face, dvec3 const& point, dvec3 const& normal,
                           std::optional<dvec2> const& size = std::nullopt);

} // namespace sahl

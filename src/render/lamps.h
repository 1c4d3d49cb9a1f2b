// In: a point, a surface's normal there, the lamps. Out: how the surface is lit, by Phong's terms.
#pragma once

#include "math/vec.h"
#include "scene/picture.h"

namespace sahl {

/// A lamp seen from a point.
struct LampView {
    dvec3 toward{0.0};     // unit, from the point to the lamp
    double distance = 0.0; // m, infinite for a directional one
    dvec3 light{0.0};      // what of its intensity comes, were nothing in between
};
LampView view_of(Light const& light, dvec3 const& point);

/// What a ray sees of the lamp itself: a glowing ball, or a disc in the sky, of the radiance by which it
/// gives the light that it gives. A ball that gives the same at any distance glows as the ray's origin needs
/// it.
///   length   m, of the ray's piece; infinite where it leaves the scene
dvec3 glow_of(Light const& light, dvec3 const& origin, dvec3 const& direction, double length);

} // namespace sahl

// In: a painted place. Out: its colour there: what a pattern or a picture multiplies the paint by.
#pragma once

#include "scene/interface.h"

namespace sahl {

/// Is some paint of the scene a chess board?
bool has_checker(Scene const& scene);

/// Multiplies ambient and diffuse of `paint` at the interface: the mean over what a sample stands for.
///   to_object      from the world to the frame of the object whose surface it is
///   across, down   m, on the surface: the sides of that; zero: a point
dvec3 pigment(Affine const& to_object, Interface const& interface, Paint const& paint, dvec3 const& across,
              dvec3 const& down);

} // namespace sahl

// In: a painted place. Out: its colour there: what a pattern or a picture multiplies the paint by.
#pragma once

#include "scene/interface.h"

namespace sahl {

/// Multiplies ambient and diffuse of `paint` at the interface.
dvec3 pigment(Scene const& scene, Interface const& interface, Paint const& paint);

} // namespace sahl

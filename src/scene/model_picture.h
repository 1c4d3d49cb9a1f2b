// In: cameras and lights of a model file. Out: the same for a picture, in the world.
#pragma once

#include "scene/model.h"
#include "scene/picture.h"

namespace sahl {

/// glTF's camera looks along −z, up is y. The picture has the aspect ratio that the file gives, 640 columns
/// or 480 rows at least. to_world   of the model's lengths
Camera camera_of(ModelCamera const& camera, Affine const& to_world);

/// KHR_lights_punctual: a lamp of I cd lights what faces it with I/d² lx at the distance d m, a directional
/// one with its I lx; a white surface shows a πth of that (cd/m²), and that is taken as the picture's 1.
/// `range` is left out: light falls off by the square of the distance alone.
Light light_of(ModelLight const& light, Affine const& to_world);

} // namespace sahl

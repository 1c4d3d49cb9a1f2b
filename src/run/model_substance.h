// In: what a body or a face is made of. Out: the material that says so in a model file, as near as it can.
#pragma once

#include "scene/model.h"
#include "scene/scene.h"

namespace sahl {

/// Clear glass: its index at the d line and its Abbe number, its absorption by bands of wavelength. Read
/// back, an index without dispersion, one given by n_d and V_d, and an absorption that is the same at all
/// wavelengths are the same; of a catalogue glass n_d and V_d are. Below 1 an index becomes 1.
///   thickness   m, > 0, for renderers that do not trace
ModelMaterial glass_material(Medium const& medium, double thickness);

/// What a face's surface does, on a body of this medium. Absorbers, and surfaces that come from model files,
/// are read back as the same but for rounding; a metal as a mirror of its reflectance at right angles in the
/// bands' middles; a Lambertian reflector and paint have their colour, and absorb when they are traced.
ModelMaterial surface_material(Surface const& surface, Scene const& scene, MediumId medium, double thickness);

} // namespace sahl

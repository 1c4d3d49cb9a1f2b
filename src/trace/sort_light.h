// In: polarised light that meets an interface, and the branches that unpolarised light would take there. Out:
// the shares of these branches for this light, and how each is polarised.
#pragma once

#include "optics/polarisation.h"
#include "trace/interact.h"
#include "trace/sources.h"

namespace sahl {

/// What a ray is emitted as: its source's light, S1 along the part of the source's axis across the ray.
PolarisedLight emitted_light(Scene const& scene, Ray const& ray);

struct SortedLight {
    PolarisedLight through, back; // where a branch goes that way
};

/// Changes the shares, and what is absorbed, to those of `light`. What a Lambertian surface scatters is
/// unpolarised; shares that an experiment gives hold for s and p alike.
SortedLight sort_light(Scene const& scene, WavelengthTable const& optics, Interface const& interface,
                       dvec3 const& direction, MediumId medium, WavelengthId wavelength,
                       PolarisedLight const& light, Branches& branches);

} // namespace sahl

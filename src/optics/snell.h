// In: a direction, a facing normal, two indices. Out: the directions of the reflected and the refracted ray.
#pragma once

#include "math/vec.h"

#include <optional>

namespace sahl {

/// Mirror direction d − 2(d·N)N, normalised.
///   direction   unit, along travel
///   normal      unit, facing: direction · normal ≤ 0
dvec3 reflect(dvec3 const& direction, dvec3 const& normal);

/// Refracted direction by Snell's law, n_incident sin i = n_transmitted sin t: the tangential part of the direction is
/// scaled and completed along −N, then normalised; no angle is ever computed.
///   direction   unit, along travel
///   normal      unit, facing: direction · normal ≤ 0
///   n_incident, n_transmitted   > 0
/// Empty is total internal reflection; it is decided without cancellation (see fresnel.h).
std::optional<dvec3> refract(dvec3 const& direction, dvec3 const& normal, double n_incident, double n_transmitted);

} // namespace sahl

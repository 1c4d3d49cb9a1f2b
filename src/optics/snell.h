// In: a direction, a facing normal, two indices. Out: the directions of the reflected and the refracted ray.
#pragma once

#include "math/vec.h"
#include "optics/fresnel.h"

#include <cmath>
#include <optional>

namespace sahl {

/// Mirror direction d − 2(d·N)N, made a unit vector again.
///   direction   unit, along travel
///   normal      unit, facing: direction · normal ≤ 0
inline dvec3 reflect(dvec3 const& direction, dvec3 const& normal) {
    return unit_again(direction - 2.0 * dot(direction, normal) * normal);
}

/// A ray's meeting with a smooth surface: its angle, and the part of its direction along the surface.
struct Approach {
    dvec3 tangential;
    Incidence incidence;

    Approach(dvec3 const& direction, dvec3 const& normal)
        : tangential(0.0), incidence{-dot(direction, normal), 0.0} {
        tangential = direction + incidence.cosine * normal;
        incidence.sine = length(tangential);
    }
};

/// Direction of the refracted ray: n_incident times the tangential part, completed along −N by
/// transmitted_normal, the square root of transmitted_normal_squared(): a vector of length n_transmitted. No
/// angle is ever computed.
inline dvec3 refracted(Approach const& approach, dvec3 const& normal, double n_incident, double n_transmitted,
                       double transmitted_normal) {
    double const scale = 1.0 / n_transmitted;
    return unit_again((scale * n_incident) * approach.tangential - (scale * transmitted_normal) * normal);
}

/// Refracted direction by Snell's law, n_incident sin i = n_transmitted sin t.
///   direction   unit, along travel
///   normal      unit, facing: direction · normal ≤ 0
///   n_incident, n_transmitted   > 0
/// Empty is total internal reflection; it is decided without cancellation (see fresnel.h).
inline std::optional<dvec3> refract(dvec3 const& direction, dvec3 const& normal, double n_incident,
                                    double n_transmitted) {
    Approach const approach(direction, normal);
    double const squared = transmitted_normal_squared(approach.incidence, n_incident, n_transmitted);
    if (squared <= 0.0)
        return std::nullopt;
    return refracted(approach, normal, n_incident, n_transmitted, std::sqrt(squared));
}

} // namespace sahl

#include "optics/snell.h"

#include "optics/fresnel.h"

#include <cmath>

namespace sahl {

dvec3 reflect(dvec3 const& direction, dvec3 const& normal) {
    return normalize(direction - 2.0 * dot(direction, normal) * normal);
}

std::optional<dvec3> refract(dvec3 const& direction, dvec3 const& normal, double n_incident, double n_transmitted) {
    double const cosine = -dot(direction, normal);
    dvec3 const tangential = direction + cosine * normal;
    double const along_normal_squared =
        transmitted_normal_squared({cosine, length(tangential)}, n_incident, n_transmitted);
    if (along_normal_squared <= 0.0)
        return std::nullopt;
    // n_t times the refracted direction: its tangential part is that of the incident ray times n_i
    return normalize(n_incident * tangential - std::sqrt(along_normal_squared) * normal);
}

} // namespace sahl

#include "render/footprint.h"

#include <algorithm>

namespace sahl {

void RayDifferential::go(double t, dvec3 const& direction, dvec3 const& normal) {
    dvec3 const moved = place + t * heading;
    double const slope = dot(direction, normal);
    place = slope == 0.0 ? moved : moved - (dot(moved, normal) / slope) * direction;
}

void RayDifferential::reflect(dvec3 const& direction, dvec3 const& normal, dvec3 const& turn) {
    double const slope = dot(direction, normal);
    double const change = dot(heading, normal) + dot(direction, turn);
    heading -= 2.0 * (slope * turn + change * normal);
}

void RayDifferential::refract(dvec3 const& direction, dvec3 const& refracted, dvec3 const& normal,
                              dvec3 const& turn, double n_incident, double n_transmitted) {
    double const ratio = n_incident / n_transmitted;
    // what leaves along the surface is spread without end; a number that is none would be no width at all
    double const slope = dot(direction, normal), slope_after = std::min(dot(refracted, normal), -1e-9);
    double const change = dot(heading, normal) + dot(direction, turn);
    double const along = ratio * slope - slope_after;
    double const along_change = (ratio - ratio * ratio * slope / slope_after) * change;
    heading = ratio * heading - (along * turn + along_change * normal);
}

} // namespace sahl

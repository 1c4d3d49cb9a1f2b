#include "image/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sahl {
namespace {

using std::numbers::pi;

/// How the place on the picture moves when the direction does: ∂(longitude / 2π, latitude / π). About the
/// poles longitude runs away, and a footprint goes once round.
dvec2 change(dvec3 const& d, dvec3 const& by) {
    double const from_axis = std::sqrt(d.x * d.x + d.z * d.z);
    if (from_axis == 0.0)
        return by == dvec3(0.0) ? dvec2(0.0) : dvec2(1.0, length(by) / pi);
    double const turn = (d.x * by.z - d.z * by.x) / (from_axis * from_axis);
    double const rise = by.y * from_axis - d.y * (d.x * by.x + d.z * by.z) / from_axis;
    return {std::clamp(turn / (2.0 * pi), -1.0, 1.0), rise / pi};
}

} // namespace

dvec2 Environment::place_of(dvec3 const& d) {
    return {0.5 + std::atan2(d.x, -d.z) / (2.0 * pi),
            0.5 + std::atan2(d.y, std::sqrt(d.x * d.x + d.z * d.z)) / pi};
}

dvec3 Environment::at(dvec3 const& direction, dvec3 const& dx, dvec3 const& dy) const {
    dvec3 const d = to_own_ * direction;
    return texture_.at(place_of(d), change(d, to_own_ * dx), change(d, to_own_ * dy));
}

} // namespace sahl

#include "render/lamps.h"

#include "math/overloaded.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

/// 1 within the inner cone, 0 beyond the outer one, smooth in the cosine in between: the square of
/// KHR_lights_punctual's angular attenuation.
double within_cone(SpotLight const& spot, dvec3 const& toward) {
    double const cosine = -dot(toward, spot.toward);
    double const outer = std::cos(spot.outer), inner = std::cos(spot.inner);
    double const share = inner > outer ? std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0)
                                       : static_cast<double>(cosine >= outer);
    return share * share;
}

/// Does the ray pass through the ball before `length`?
bool passes_ball(dvec3 const& to_centre, double radius, dvec3 const& direction, double length) {
    double const along = dot(to_centre, direction);
    dvec3 const beside = to_centre - along * direction;
    return along > 0.0 && along < length && dot(beside, beside) < radius * radius;
}

} // namespace

dvec3 glow_of(Light const& light, dvec3 const& origin, dvec3 const& direction, double length) {
    if (light.radius <= 0.0)
        return dvec3(0.0);
    if (auto const* const sun = std::get_if<DirectionalLight>(&light.kind)) {
        double const sine = std::sin(light.radius);
        bool const seen = std::isinf(length) && -dot(direction, sun->toward) > std::cos(light.radius);
        return seen ? light.intensity / (sine * sine) : dvec3(0.0);
    }
    auto const* const point = std::get_if<PointLight>(&light.kind);
    dvec3 const to_centre = (point ? point->at : std::get<SpotLight>(light.kind).at) - origin;
    if (!passes_ball(to_centre, light.radius, direction, length))
        return dvec3(0.0);
    LampView const view = view_of(light, origin); // light = intensity · (falloff / distance)²
    double const wide = view.distance / light.radius;
    return wide * wide * view.light;
}

LampView view_of(Light const& light, dvec3 const& point) {
    LampView view;
    auto const from = [&](dvec3 const& at) {
        dvec3 const way = at - point;
        view.distance = length(way);
        view.toward = view.distance > 0.0 ? way / view.distance : dvec3(0.0);
        double const nearness = light.falloff > 0.0 ? light.falloff / view.distance : 1.0;
        view.light = view.distance > 0.0 ? nearness * nearness * light.intensity : dvec3(0.0);
    };
    std::visit(Overloaded{[&](PointLight const& point_light) { from(point_light.at); },
                          [&](SpotLight const& spot) {
                              from(spot.at);
                              view.light *= within_cone(spot, view.toward);
                          },
                          [&](DirectionalLight const& sun) {
                              view = {-sun.toward, INFINITY, light.intensity};
                          }},
               light.kind);
    return view;
}

} // namespace sahl

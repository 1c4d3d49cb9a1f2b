// In: triangles and how they hang together. Out: the closed components, and which of them lie inside out.
#include "geometry/mesh_shells.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

void measure(ClosedComponent& component, std::span<dvec3 const> places) {
    component.low = component.high = places[component.triangles.front()[0]];
    for (Corners const& t : component.triangles)
        for (std::uint32_t const corner : t) {
            component.low = glm::min(component.low, places[corner]);
            component.high = glm::max(component.high, places[corner]);
        }
    dvec3 const centre = 0.5 * (component.low + component.high);
    for (Corners const& t : component.triangles)
        component.signed_volume +=
            dot(places[t[0]] - centre, cross(places[t[1]] - centre, places[t[2]] - centre)) / 6.0;
}

bool is_inside(ClosedComponent const& inner, ClosedComponent& outer, std::span<dvec3 const> places) {
    Corners const& t = inner.triangles.front();
    dvec3 const point = (places[t[0]] + places[t[1]] + places[t[2]]) / 3.0;
    if (glm::min(point, outer.low) != outer.low || glm::max(point, outer.high) != outer.high)
        return false;
    if (!outer.shadow)
        outer.shadow = make_shadow(places, outer.triangles);
    return winding_number(*outer.shadow, point) != 0;
}

} // namespace

std::vector<ClosedComponent> closed_components(std::span<Corners const> corners, Topology const& topology,
                                               std::span<dvec3 const> places) {
    std::vector<ClosedComponent> components(topology.open.size());
    for (std::size_t t = 0; t < corners.size(); ++t)
        if (!topology.open[topology.component[t]])
            components[topology.component[t]].triangles.push_back(corners[t]);
    for (ClosedComponent& component : components)
        if (!component.triangles.empty())
            measure(component, places);
    return components;
}

std::vector<bool> outermost_inside_out(std::vector<ClosedComponent>& components,
                                       std::span<dvec3 const> places) {
    std::vector<std::uint32_t> largest_first;
    for (std::uint32_t i = 0; i < components.size(); ++i)
        if (!components[i].triangles.empty())
            largest_first.push_back(i);
    std::sort(largest_first.begin(), largest_first.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::abs(components[a].signed_volume) > std::abs(components[b].signed_volume);
    });
    std::vector<bool> wrong(components.size(), false);
    for (std::uint32_t const i : largest_first)
        wrong[i] = components[i].signed_volume < 0.0 &&
                   std::none_of(largest_first.begin(), largest_first.end(), [&](std::uint32_t other) {
                       return other != i && is_inside(components[i], components[other], places);
                   });
    return wrong;
}

} // namespace sahl

#include "run/holes.h"

#include "geometry/mesh_health.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

namespace sahl {

std::vector<Hole> holes_of(Scene const& scene) {
    std::vector<Hole> holes;
    std::map<Mesh const*, std::vector<Border>> known; // instances share one
    for (std::uint32_t body = 0; body < scene.bodies.size(); ++body) {
        Body const& object = scene.bodies[body];
        if (!object.mesh || object.open || object.mesh->boundary_edges == 0)
            continue;
        auto const [borders, is_new] = known.try_emplace(object.mesh.get());
        if (is_new)
            borders->second = health_of(*object.mesh).longest_borders;
        double const scale = std::cbrt(std::abs(glm::determinant(object.to_world.linear)));
        for (Border const& border : borders->second)
            holes.push_back({{body},
                             object.to_world.point(border.centre),
                             scale * border.length / (2.0 * std::numbers::pi),
                             border.edges,
                             0});
    }
    return holes;
}

void count_leak(std::vector<Hole>& holes, LostRay const& ray) {
    if (holes.empty() || ray.event != Event::leak)
        return;
    auto const off = [&](Hole const& hole) {
        return length(cross(hole.centre - ray.origin, ray.direction)) / hole.radius;
    };
    ++std::min_element(holes.begin(), holes.end(), [&](Hole const& a, Hole const& b) {
          return off(a) < off(b);
      })->leaks;
}

std::vector<std::string> unclosed_warnings(Scene const& scene) {
    std::vector<std::string> warnings;
    for (Body const& body : scene.bodies) {
        if (!body.mesh || body.open || body.mesh->closed())
            continue;
        char text[200];
        std::snprintf(text, sizeof text,
                      ": it is not closed (%llu border edges, %llu edges of more than two triangles): rays "
                      "that find a hole are counted as leaks; sahl check says where",
                      static_cast<unsigned long long>(body.mesh->boundary_edges),
                      static_cast<unsigned long long>(body.mesh->non_manifold_edges));
        warnings.push_back(body.name + text);
    }
    return warnings;
}

std::vector<std::string> hole_warnings(Scene const& scene, std::vector<Hole> const& holes) {
    std::vector<std::string> warnings;
    for (Hole const& hole : holes) {
        if (hole.leaks == 0)
            continue;
        char text[200];
        std::snprintf(
            text, sizeof text,
            ": %llu rays leaked at the hole of %llu edges round (%.6g, %.6g, %.6g) mm; close it there",
            static_cast<unsigned long long>(hole.leaks), static_cast<unsigned long long>(hole.edges),
            hole.centre.x * 1e3, hole.centre.y * 1e3, hole.centre.z * 1e3);
        warnings.push_back(scene.bodies[hole.body.value].name + text);
    }
    return warnings;
}

} // namespace sahl

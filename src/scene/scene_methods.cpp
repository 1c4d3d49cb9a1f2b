#include "scene/scene_methods.h"

#include "scene/model_body.h"

namespace sahl {

BodyMethod body_method(Method method) {
    return {method == Method::interpolated, curving_of(method)};
}

char const* name_of(Method method) {
    constexpr char const* names[] = {"auto", "facet", "interpolated", "quadratic", "fitted", "recognised"};
    return names[static_cast<std::size_t>(method)];
}

std::unique_ptr<Bvh const> bvh_with(Scene const& scene, std::span<BodyMethod const> methods,
                                    MeshStore* store) {
    std::vector<PlacedGeometry> geometries;
    FaceId face{0};
    ShellId shell{0};
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        Body const& body = scene.bodies[i];
        PlacedGeometry placed{Shape(Sphere{}), body.to_world, face, shell, body.detector.has_value(), false};
        std::size_t shells = body.open ? 0 : 1;
        if (body.mesh) {
            placed.geometry = body.mesh;
            // an open one that touches something is met by its triangles
            placed.interpolate = methods[i].interpolate || (body.open && methods[i].curving != Curving::none);
            placed.open = body.open;
            placed.curving = methods[i].curving;
            face.value += static_cast<std::uint32_t>(body.mesh->soup.face_names.size());
            shells = body.open ? 0 : body.mesh->shells.size();
        } else {
            placed.geometry = *body.shape;
            face.value += static_cast<std::uint32_t>(face_names(*body.shape).size());
        }
        shell.value += static_cast<std::uint32_t>(shells);
        geometries.push_back(std::move(placed));
    }
    return std::make_unique<Bvh const>(std::move(geometries), store);
}

} // namespace sahl

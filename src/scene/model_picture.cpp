#include "scene/model_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sahl {

namespace {

constexpr std::uint32_t least_columns = 640, least_rows = 480, most_pixels = 32768;

dvec3 unit_or(dvec3 const& v, dvec3 const& otherwise) {
    double const size = length(v);
    return size > 0.0 && std::isfinite(size) ? v / size : otherwise;
}

std::uint32_t rounded(double pixels) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(pixels, 1.0, double{most_pixels})));
}

/// width / height
void shape(Camera& camera, double aspect) {
    bool const wide = aspect * least_rows >= least_columns;
    camera.columns = wide ? rounded(aspect * least_rows) : least_columns;
    camera.rows = wide ? least_rows : rounded(least_columns / aspect);
}

} // namespace

Camera camera_of(ModelCamera const& from, Affine const& to_world) {
    Affine const place = compose(to_world, from.to_world);
    Camera camera;
    camera.at = place.offset;
    camera.forward = unit_or(place.vector({0, 0, -1}), {0, 0, -1});
    camera.up = perpendicular_to(camera.forward, place.vector({0, 1, 0}));
    if (from.perspective) {
        camera.fov = from.yfov;
        if (from.aspect > 0.0)
            shape(camera, from.aspect);
    } else {
        camera.height = 2.0 * from.ymag * length(place.vector({0, 1, 0}));
        shape(camera, from.xmag * length(place.vector({1, 0, 0})) / (0.5 * camera.height));
    }
    return camera;
}

Light light_of(ModelLight const& from, Affine const& to_world) {
    Affine const place = compose(to_world, from.to_world);
    dvec3 const toward = unit_or(place.vector({0, 0, -1}), {0, 0, -1});
    Light light;
    light.intensity = from.intensity / std::numbers::pi * dvec3(from.color[0], from.color[1], from.color[2]);
    light.falloff = 1.0;
    switch (from.kind) {
    case ModelLight::Kind::directional:
        light.kind = DirectionalLight{toward};
        light.falloff = 0.0;
        break;
    case ModelLight::Kind::point:
        light.kind = PointLight{place.offset};
        break;
    case ModelLight::Kind::spot:
        light.kind = SpotLight{place.offset, toward, from.inner_cone, from.outer_cone};
        break;
    }
    return light;
}

} // namespace sahl

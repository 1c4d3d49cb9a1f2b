#include "render/surface_colour.h"

#include <cmath>

namespace sahl {

namespace {

/// Half a cube's side is far more than rounding, and far less than what is seen: by so much of it a point is
/// taken below the surface, since a face often lies where two cubes meet.
constexpr double below_surface = 1e-6;

dvec3 of_checker(Checker const& checker, dvec3 const& at) {
    dvec3 const cube = glm::floor(at / checker.size);
    double const odd = cube.x + cube.y + cube.z;
    return odd == 2.0 * std::floor(0.5 * odd) ? dvec3(1.0)
                                              : dvec3(checker.other[0], checker.other[1], checker.other[2]);
}

} // namespace

dvec3 pigment(Scene const& scene, Interface const& interface, Paint const& paint) {
    if (!paint.checker)
        return dvec3(1.0);
    Body const& body = scene.bodies[scene.faces[interface.face.value].body.value];
    Affine const to_object = inverse(body.to_world);
    dvec3 const inward = -normalize(to_object.vector(interface.facet_normal));
    return of_checker(*paint.checker,
                      to_object.point(interface.point) + below_surface * paint.checker->size * inward);
}

} // namespace sahl

#include "render/surface_colour.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

/// Of a cube's side: far more than rounding, and far less than what is seen. By so much a point is taken
/// below the surface, since a face often lies where two cubes meet.
constexpr double below_surface = 1e-6;

/// Mean over [x − w/2, x + w/2] of the wave that is 1 from 0 to 1, −1 from 1 to 2, and so on.
double mean_of_wave(double x, double w) {
    auto const phase = [](double at) { return at - 2.0 * std::floor(0.5 * at); };
    double const left = phase(x - 0.5 * w);
    if (left + w <= 1.0 || (left >= 1.0 && left + w <= 2.0)) // as good as a point, and most are
        return left < 1.0 ? 1.0 : -1.0;
    auto const integral = [&](double at) { return 1.0 - std::abs(1.0 - phase(at)); };
    return (integral(x + 0.5 * w) - integral(x - 0.5 * w)) / w;
}

/// Over a box about `at` with these sides, in cubes' sides: how much more there is of the cubes that are
/// even.
double mean_of_cubes(dvec3 const& at, dvec3 const& sides) {
    return mean_of_wave(at.x, sides.x) * mean_of_wave(at.y, sides.y) * mean_of_wave(at.z, sides.z);
}

constexpr int parts_across = 3, most_parts_along = 16;

/// Over a parallelogram: over the boxes about its parts, which, where it lies askew, reach beyond it by as
/// much as a part is wide.
double mean_of_cubes(dvec3 const& at, dvec3 longer, dvec3 shorter) {
    double const whole = mean_of_cubes(at, glm::abs(longer) + glm::abs(shorter));
    if (std::abs(whole) == 1.0)
        return whole;
    if (dot(longer, longer) < dot(shorter, shorter))
        std::swap(longer, shorter);
    double const slender = length(longer) / std::max(length(shorter), 1e-3 * length(longer));
    int const along = std::min(most_parts_along, parts_across * static_cast<int>(std::ceil(slender)));
    dvec3 const sides =
        glm::abs(longer) / static_cast<double>(along) + glm::abs(shorter) / (1.0 * parts_across);
    double sum = 0.0;
    for (int i = 0; i < along; ++i)
        for (int j = 0; j < parts_across; ++j)
            sum += mean_of_cubes(
                at + ((i + 0.5) / along - 0.5) * longer + ((j + 0.5) / parts_across - 0.5) * shorter, sides);
    return sum / (1.0 * along * parts_across);
}

/// In cubes' sides; zero where a sample stands for a point, or for more than is finite.
dvec3 in_cubes(dvec3 const& along, Affine const& to_object, double size) {
    if (along == dvec3(0.0))
        return along;
    dvec3 const side = to_object.vector(along) / size;
    return std::isfinite(side.x + side.y + side.z) ? side : dvec3(0.0);
}

} // namespace

bool has_checker(Scene const& scene) {
    return std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [](Surface const& surface) {
        auto const* const paint = std::get_if<Paint>(&surface.kind);
        return paint && paint->checker;
    });
}

dvec3 pigment(Affine const& to_object, Interface const& interface, Paint const& paint, dvec3 const& across,
              dvec3 const& down) {
    if (!paint.checker)
        return dvec3(1.0);
    Checker const& checker = *paint.checker;
    dvec3 const inward = -normalize(to_object.vector(interface.facet_normal));
    dvec3 const at = to_object.point(interface.point) / checker.size + below_surface * inward;
    double const even =
        mean_of_cubes(at, in_cubes(across, to_object, checker.size), in_cubes(down, to_object, checker.size));
    dvec3 const other(checker.other[0], checker.other[1], checker.other[2]);
    return 0.5 * ((1.0 + even) * dvec3(1.0) + (1.0 - even) * other);
}

} // namespace sahl

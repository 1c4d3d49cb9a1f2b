// Grazing, near-critical and normal incidence, where a sign or a square root decides.
#include "torture/aim.h"
#include "torture/cases.h"

#include <limits>

namespace sahl::bench {

namespace {

/// Grazing angles at which the line still dips below the surface by more than rounding: g² R / 2.
double least_grazing(double radius, double offset) {
    return std::max(
        1e-6, std::sqrt(1024.0 * std::numeric_limits<double>::epsilon() * (1.0 + 2.0 * offset / radius)));
}

void add_ball(std::vector<TortureCase>& cases, double radius, double offset, Dice& dice, bool exact) {
    Affine const place{dice.rotation(), offset * dice.direction()};
    std::string const where = ", radius " + std::to_string(radius).substr(0, 8) + ", " +
                              std::to_string(static_cast<int>(offset / radius)) + " radii away";
    TortureCase made{"grazing a ball" + where, exact ? "exact" : "mesh", {1.0, 1.5}, {}, {}};
    // far off a line along a facet is moved sideways by offset · 2⁻⁵² / g: to another facet, if it passes by
    // its edge
    double const least = exact ? least_grazing(radius, offset) : std::max(1e-6, 3e-8 * offset / radius);
    MeshRef const mesh = exact ? nullptr : mesh_of(ball_soup(radius, 3));
    if (exact)
        made.parts.push_back({Sphere{radius}, 1, place});
    else
        made.parts.push_back({mesh, 1, place});
    made.ray = [=](Dice& d, std::uint64_t k) {
        double const grazing = d.log_between(least, 0.1);
        if (exact) {
            dvec3 const normal = d.direction(), along = along_surface(normal, grazing, d);
            // from outside, or from half way along the chord
            double const before = k % 3 ? 2.0 * radius : -radius * std::sin(grazing);
            return through(place, radius * normal, along, before);
        }
        OnTriangle const at = on_triangle(*mesh, d, 0);
        return through(place, at.point, along_surface(at.normal, grazing, d), 0.5 * radius);
    };
    cases.push_back(std::move(made));
}

void add_critical(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact) {
    Dice dice(500 + variant);
    double const n = variant ? dice.between(1.2, 3.5) : 1.5;
    Affine const place = variant ? Affine{dice.rotation(), dice.direction()} : Affine{};
    TortureCase made{"near the critical angle", exact ? "exact" : "mesh", {1.0, n}, {}, {}};
    if (exact)
        made.parts.push_back({Box{dvec3(2.0)}, 1, place});
    else
        made.parts.push_back({mesh_of(box_soup(dvec3(-1.0), dvec3(1.0))), 1, place});
    made.rule = Rule::transmit;
    made.events = 3;
    made.ray = [=](Dice& d, std::uint64_t k) {
        dvec3 normal(0.0);
        normal[static_cast<int>(k % 3)] = d.sign();
        double const angle = std::asin(1.0 / n) + d.sign() * d.log_between(1e-13, 1e-1);
        dvec3 const along =
            std::sin(angle) * perpendicular_to(normal, d.direction()) + std::cos(angle) * normal;
        dvec3 point = d.in_box(dvec3(-0.9), dvec3(0.9));
        point[static_cast<int>(k % 3)] = normal[static_cast<int>(k % 3)];
        TortureRay ray = through(place, point, along, 0.05);
        return ray;
    };
    cases.push_back(std::move(made));
}

/// Along the normal, where a cosine may round above 1.
void add_normal(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact) {
    Dice dice(600 + variant);
    Affine const place{dice.rotation(), variant ? dice.in_box(dvec3(-1.0), dvec3(1.0)) : dvec3(0.0)};
    MeshRef const mesh = mesh_of(ball_soup(1.0, 2));
    TortureCase made{"along the normal", exact ? "exact" : "mesh", {1.0, 1.5, 1.33}, {}, {}};
    if (exact) {
        made.parts = {{Sphere{1.0}, 1, place}, {Sphere{0.5}, 2, place}};
    } else {
        made.parts = {{mesh, 1, place}, {mesh_of(ball_soup(0.5, 2)), 2, place}};
    }
    made.ray = [=](Dice& d, std::uint64_t k) {
        OnTriangle const at = on_triangle(*mesh, d, 0);
        dvec3 const normal = exact ? d.direction() : at.normal;
        return through(place, exact ? normal : at.point, k % 2 ? -normal : normal, k % 2 ? 2.0 : 1e-3);
    };
    cases.push_back(std::move(made));
}

} // namespace

void add_grazing_cases(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Dice dice(400 + variant);
    for (bool exact : {true, false})
        for (double radius : {1e-3, 1.0, 1e3})
            for (double far : {0.0, 1e3, 1e5}) {
                double const r = variant ? radius * dice.between(0.5, 2.0) : radius;
                add_ball(cases, r, far * r, dice, exact);
            }
    for (bool exact : {true, false}) {
        add_critical(cases, variant, exact);
        add_normal(cases, variant, exact);
    }
}

} // namespace sahl::bench

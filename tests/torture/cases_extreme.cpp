// Thin shells, bodies far away, all scales in one scene, rays that are born on a surface or inside, every
// exact shape.
#include "geometry/shape_oracle.h"
#include "torture/aim.h"
#include "torture/cases.h"

#include <numbers>

namespace sahl::bench {

namespace {

TortureRay about(Affine const& place, double size, double before, Dice& d) {
    return through(place, 0.5 * size * d.uniform() * d.direction(), d.direction(), before);
}

void add_thin_shell(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact, bool one_mesh,
                    double far) {
    Dice dice(1700 + variant);
    double const thin = variant ? dice.log_between(1e-7, 1e-5) : 1e-6;
    Affine const place{dice.rotation(), far * dice.direction()};
    TortureCase made{far > 0.0 ? "a shell of 1e-6, far away" : "a shell of 1e-6",
                     exact ? "exact" : "mesh",
                     {1.0, 1.5, 1.0},
                     {},
                     {}};
    MeshRef const outer = mesh_of(ball_soup(1.0, 3));
    if (exact) {
        made.parts = {{Sphere{1.0}, 1, place}, {Sphere{1.0 - thin}, 2, place}};
    } else if (one_mesh) {
        made.name += ", as one mesh";
        made.parts = {{mesh_of(together(ball_soup(1.0, 3), inside_out(ball_soup(1.0 - thin, 3)))), 1, place}};
    } else {
        made.parts = {{outer, 1, place}, {mesh_of(ball_soup(1.0 - thin, 3)), 2, place}};
    }
    made.ray = [=](Dice& d, std::uint64_t k) {
        double const grazing = k % 2 ? d.log_between(1e-2, 1.5) : 1.5;
        if (exact) {
            dvec3 const normal = d.direction();
            return through(place, normal, along_surface(normal, grazing, d), 1.0);
        }
        OnTriangle const at = on_triangle(*outer, d, 0);
        return through(place, at.point, along_surface(at.normal, grazing, d), 0.3);
    };
    cases.push_back(std::move(made));
}

void add_scales(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact) {
    Dice dice(1800 + variant);
    dvec3 const bead = variant ? dice.in_box(dvec3(-1e-4), dvec3(1e-4)) : dvec3(1e-4, -2e-4, 3e-4);
    TortureCase made{
        "micrometres to kilometres", exact ? "exact" : "mesh", {1.0, 1.33, 1.5, 1.4, 1.7}, {}, {}};
    auto const ball = [&](double radius, dvec3 const& at, std::uint32_t medium) {
        Affine const place{dice.rotation(), at};
        if (exact)
            return TorturePart{Sphere{radius}, medium, place};
        return TorturePart{mesh_of(ball_soup(radius, 2)), medium, place};
    };
    made.parts = {ball(1e3, dvec3(0.0), 1), ball(1.0, {0.1, 0.2, 0.3}, 2), ball(1e-3, dvec3(0.0), 3),
                  ball(1e-6, bead, 4)};
    made.ray = [=](Dice& d, std::uint64_t k) {
        dvec3 const direction = d.direction();
        return through({}, bead + 0.5e-6 * d.uniform() * d.direction(), direction,
                       k % 3 == 0   ? 3e-3
                       : k % 3 == 1 ? 1e-6
                                    : 3.0);
    };
    cases.push_back(std::move(made));
}

void add_far(std::vector<TortureCase>& cases, std::uint64_t variant, std::variant<Shape, MeshRef> body,
             std::string const& name, std::string const& of) {
    Dice dice(1900 + variant);
    Affine const place{dice.rotation(), 1e5 * (variant ? dice.between(0.5, 1.0) : 1.0) * dice.direction()};
    TortureCase made{name + ", 1e5 radii away", of, {1.0, 1.5}, {{std::move(body), 1, place}}, {}};
    made.ray = [=](Dice& d, std::uint64_t) { return about(place, 1.0, 3.0, d); };
    cases.push_back(std::move(made));
}

/// Born on the surface, to either side, and inside.
void add_births(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact) {
    Dice dice(2000 + variant);
    Affine const place = variant ? Affine{dice.rotation(), dice.in_box(dvec3(-1.0), dvec3(1.0))} : Affine{};
    MeshRef const mesh = mesh_of(ball_soup(1.0, 2));
    TortureCase made{"a source on a surface, and inside", exact ? "exact" : "mesh", {1.0, 1.5}, {}, {}};
    if (exact)
        made.parts = {{Sphere{1.0}, 1, place}};
    else
        made.parts = {{mesh, 1, place}};
    made.ray = [=](Dice& d, std::uint64_t k) {
        if (k % 3 == 0)
            return through(place, 0.5 * d.uniform() * d.direction(), d.direction(), 0.0);
        OnTriangle at = on_triangle(*mesh, d, 0);
        if (exact)
            at = {d.direction(), dvec3(0.0), 0};
        dvec3 const normal = exact ? at.point : at.normal;
        // at grazing angles too, of which 1e-5 dips by 5e-11 below a ball
        dvec3 const direction = along_surface(d.sign() * normal, d.log_between(1e-5, 1.5), d);
        TortureRay ray = through(place, at.point, direction, 0.0);
        ray.part = 0;
        ray.face = at.triangle;
        return ray;
    };
    cases.push_back(std::move(made));
}

/// Every closed shape of planes, balls and tubes, met anywhere and at its edges.
void add_zoo(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Dice dice(2100 + variant);
    for (auto const& [name, shape] : simple_shapes()) {
        Affine const place{dice.log_between(1e-2, 1e2) * dice.rotation(),
                           dice.in_box(dvec3(-1.0), dvec3(1.0))};
        TortureCase made{
            name, "exact", {1.0, variant ? dice.between(1.1, 2.5) : 1.5}, {{shape, 1, place}}, {}};
        made.ray = [=, shape = shape](Dice& d, std::uint64_t k) {
            dvec3 const in = middle(shape), edge = edge_point(shape, d);
            dvec3 const target =
                k % 2 ? in + 0.7 * d.uniform() * (edge - in) : in + d.between(0.9, 1.1) * (edge - in);
            return through(place, target, d.direction(), k % 3 ? 5.0 : 1e-3);
        };
        cases.push_back(std::move(made));
    }
}

/// Mirrored and stretched: the sides and the normals change.
void add_distorted(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact) {
    Dice dice(2200 + variant);
    dmat3 const stretch({-1.5, 0.0, 0.0}, {0.0, 0.4, 0.0}, {0.3, 0.0, 1.0});
    Affine const place{dice.rotation() * stretch, dice.in_box(dvec3(-1.0), dvec3(1.0))};
    TortureCase made{"a mirrored, stretched, sheared ball with a bubble",
                     exact ? "exact" : "mesh",
                     {1.0, 1.5, 1.0},
                     {},
                     {}};
    if (exact)
        made.parts = {{Sphere{1.0}, 1, place}, {Sphere{0.4}, 2, place}};
    else
        made.parts = {{mesh_of(together(ball_soup(1.0, 2), inside_out(ball_soup(0.4, 2)))), 1, place}};
    made.ray = [=](Dice& d, std::uint64_t k) { return about(place, 1.8, k % 2 ? 4.0 : 0.05, d); };
    cases.push_back(std::move(made));
}

} // namespace

void add_extreme_cases(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Dice dice(variant + 11);
    for (double far : {0.0, 1e3}) {
        add_thin_shell(cases, variant, true, false, far);
        add_thin_shell(cases, variant, false, false, far);
        add_thin_shell(cases, variant, false, true, far);
    }
    for (bool exact : {true, false}) {
        add_scales(cases, variant, exact);
        add_births(cases, variant, exact);
        add_distorted(cases, variant, exact);
    }
    double const radius = 1.0;
    add_far(cases, variant, Sphere{radius}, "a ball", "exact");
    add_far(cases, variant, Box{dvec3(1.5)}, "a box", "exact");
    add_far(cases, variant, Lens{2.0, -3.0, 0.3, 1.0}, "a lens", "exact");
    add_far(cases, variant, mesh_of(ball_soup(radius, 3)), "a ball", "mesh");
    add_far(cases, variant, mesh_of(torus_soup(0.7, 0.3, 24, 16)), "a torus", "mesh");
    add_zoo(cases, variant);
}

std::vector<TortureCase> torture_cases(std::uint64_t variant) {
    std::vector<TortureCase> cases;
    add_edge_cases(cases, variant);
    add_grazing_cases(cases, variant);
    add_contact_cases(cases, variant);
    add_endless_cases(cases, variant);
    add_extreme_cases(cases, variant);
    add_mixed_cases(cases, variant);
    add_combined_cases(cases, variant);
    return cases;
}

} // namespace sahl::bench

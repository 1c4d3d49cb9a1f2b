// Rays aimed at edges, corners, the apex of a fan, the vertices of meshes, on purpose as symmetric lenses and
// beams on grids do. They go straight on: what they meet is known, whichever face of an edge is said to be
// met.
#include "torture/aim.h"
#include "torture/cases.h"

namespace sahl::bench {

namespace {

Affine any_place(Dice& dice, std::uint64_t variant) {
    return variant
               ? Affine{dice.log_between(0.1, 10.0) * dice.rotation(), dice.in_box(dvec3(-1.0), dvec3(1.0))}
               : Affine{};
}

/// Through a point of the border and one inside, from outside or from there.
TortureRay by_way_of(Affine const& place, dvec3 const& border, dvec3 const& inner, bool from_inside,
                     double size) {
    dvec3 const direction = from_inside ? border - inner : inner - border;
    if (from_inside)
        return {place.point(inner), normalize(place.vector(direction))};
    return through(place, border, direction, 3.0 * size);
}

void add_box(std::vector<TortureCase>& cases, std::uint64_t variant, int kind_of_body) {
    Dice dice(100 + variant);
    dvec3 const high = variant ? dice.in_box(dvec3(0.3), dvec3(1.0)) : dvec3(1.0);
    Affine const place = any_place(dice, variant);
    TortureCase made{
        "edges, corners and diagonals of a box", kind_of_body ? "mesh" : "exact", {1.0, 1.5}, {}, {}};
    if (kind_of_body)
        made.parts.push_back({mesh_of(box_soup(-high, high, kind_of_body == 2)), 1, place});
    else
        made.parts.push_back({Box{2.0 * high}, 1, place});
    if (kind_of_body == 2)
        made.name += ", other diagonals";
    made.rule = Rule::straight;
    made.faces = false;
    made.ray = [=](Dice& d, std::uint64_t k) {
        dvec3 const border = of_box(-high, high, d, 1 + static_cast<int>(k % 3));
        // the opposite corner, the middle, or any point inside
        dvec3 const inner = k % 7 == 0   ? -0.5 * border
                            : k % 7 == 1 ? dvec3(0.0)
                                         : of_box(-0.9 * high, 0.9 * high, d, 0);
        return by_way_of(place, border, inner, k % 2, 1.0);
    };
    cases.push_back(std::move(made));
}

/// Through edges and corners of a mesh and a point near its middle.
void add_mesh(std::vector<TortureCase>& cases, std::uint64_t variant, std::string name, MeshRef const& mesh,
              double inner_radius) {
    Dice dice(200 + variant);
    Affine const place = any_place(dice, variant);
    TortureCase made{std::move(name), "mesh", {1.0, 1.5}, {{mesh, 1, place}}, {}};
    made.rule = Rule::straight;
    made.faces = false;
    made.ray = [=](Dice& d, std::uint64_t k) {
        dvec3 const border = on_triangle(*mesh, d, 1 + static_cast<int>(k % 2)).point;
        dvec3 const inner = k % 5 == 0 ? dvec3(0.0) : inner_radius * d.uniform() * d.direction();
        return by_way_of(place, border, inner, k % 3 == 0, 1.0);
    };
    cases.push_back(std::move(made));
}

/// Parallel to an axis, at every vertex of the half that faces it.
void add_grid(std::vector<TortureCase>& cases, std::uint64_t variant, std::string name, MeshRef const& mesh,
              Rule rule) {
    Dice dice(300 + variant);
    Affine const place = any_place(dice, variant);
    dvec3 const axis = variant ? dice.direction() : dvec3(0.0, 0.0, 1.0);
    TortureCase made{std::move(name), "mesh", {1.0, 1.5}, {{mesh, 1, place}}, {}};
    made.rule = rule;
    made.faces = false;
    std::vector<dvec3> steep; // corners none of whose triangles is seen from its edge
    std::vector<double> least(mesh->soup.positions.size(), 1.0);
    for (auto const& t : mesh->soup.triangles) {
        auto const& p = mesh->soup.positions;
        double const along = dot(axis, normalize(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])));
        for (std::uint32_t corner : t)
            least[corner] = std::min(least[corner], -along);
    }
    for (std::size_t i = 0; i < least.size(); ++i)
        if (least[i] > 0.05)
            steep.push_back(mesh->soup.positions[i]);
    made.ray = [=](Dice& d, std::uint64_t) {
        return through(place, steep[d.below(steep.size())], axis, 3.0);
    };
    cases.push_back(std::move(made));
}

/// Parallel to an edge of a box, close to it, inside or outside.
void add_along_edge(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact) {
    Dice dice(350 + variant);
    Affine const place = variant ? Affine{dice.rotation(), dice.in_box(dvec3(-1.0), dvec3(1.0))} : Affine{};
    TortureCase made{"along the edges of a box", exact ? "exact" : "mesh", {1.0, 1.5}, {}, {}};
    if (exact)
        made.parts.push_back({Box{dvec3(2.0)}, 1, place});
    else
        made.parts.push_back({mesh_of(box_soup(dvec3(-1.0), dvec3(1.0))), 1, place});
    made.rule = Rule::straight;
    made.faces = false;
    double const least = variant ? 1e-11 : 1e-13; // above the rounding of a direction times the edge's length
    made.ray = [=](Dice& d, std::uint64_t) {
        int const axis = static_cast<int>(d.below(3));
        dvec3 p(d.sign(), d.sign(), d.sign()), direction(0.0);
        p[axis] = 0.0;
        direction[axis] = d.sign();
        p[(axis + 1) % 3] += d.sign() * d.log_between(least, 1e-3);
        p[(axis + 2) % 3] += d.sign() * d.log_between(least, 1e-3);
        return through(place, p, direction, 3.0);
    };
    cases.push_back(std::move(made));
}

/// A box whose faces are grids, and rays along an axis at the corners of the grid.
void add_grid_box(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Dice dice(360 + variant);
    auto const n = static_cast<std::uint32_t>(variant ? 2 + dice.below(9) : 8);
    MeshRef const mesh = mesh_of(grid_box_soup(n));
    TortureCase made{"a beam on the grid of a box", "mesh", {1.0, 1.5}, {{mesh}}, {}};
    if (variant % 2)
        made.parts[0].place = {dmat3({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}), dvec3(0.0)}; // mirrored
    made.rule = Rule::straight;
    made.faces = false;
    made.ray = [=](Dice& d, std::uint64_t) {
        auto const at = [&] { return -1.0 + 2.0 * double(1 + d.below(n - 1)) / n; };
        int const axis = static_cast<int>(d.below(3));
        dvec3 p(at(), at(), at()), direction(0.0);
        direction[axis] = d.sign();
        if (d.below(2)) // in a plane of the grid
            direction[(axis + 1) % 3] = d.between(-0.9, 0.9);
        return through({}, p, direction, 5.0);
    };
    cases.push_back(std::move(made));
}

} // namespace

void add_edge_cases(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Dice dice(variant);
    for (int kind : {0, 1, 2})
        add_box(cases, variant, kind);
    for (bool exact : {true, false})
        add_along_edge(cases, variant, exact);
    add_grid_box(cases, variant);
    auto const fan = static_cast<std::uint32_t>(variant ? 5 + dice.below(200) : 64);
    MeshRef const cone =
        mesh_of(revolved({{0.0, -1.0}, {1.0, -1.0}, {0.0, 1.0}}, fan, variant ? dice.uniform() : 0.0));
    TortureCase apex{"a fan's apex", "mesh", {1.0, 1.5}, {{cone}}, {}};
    apex.rule = Rule::straight;
    apex.faces = false;
    apex.ray = [](Dice& d, std::uint64_t k) {
        dvec3 const inner(0.1 * d.direction() - dvec3(0.0, 0.0, 0.5));
        return by_way_of({}, {0.0, 0.0, 1.0}, k % 3 ? inner : dvec3(0.0), k % 2, 1.0);
    };
    cases.push_back(apex);
    std::uint32_t const around = variant ? 12 + static_cast<std::uint32_t>(dice.below(40)) : 24;
    MeshRef const ball = mesh_of(ball_soup(1.0, 3)),
                  turned = mesh_of(revolved(
                      {{0.0, -1.0}, {0.6, -0.8}, {0.8, -0.6}, {1.0, 0.0}, {0.8, 0.6}, {0.6, 0.8}, {0.0, 1.0}},
                      around)),
                  bubble = mesh_of(together(ball_soup(1.0, 2), inside_out(ball_soup(0.5, 2)))),
                  torus = mesh_of(torus_soup(1.0, 0.4, around, 12));
    add_mesh(cases, variant, "vertices and edges of a ball", ball, 0.5);
    add_mesh(cases, variant, "vertices and edges of a body of revolution", turned, 0.3);
    add_mesh(cases, variant, "vertices and edges of a bubble in a ball", bubble, 0.2);
    add_grid(cases, variant, "a beam on a ball's vertices", ball, Rule::straight);
    add_grid(cases, variant, "a beam on a torus's vertices", torus, Rule::straight);
    add_grid(cases, variant, "a refracted beam on a ball's vertices", ball, Rule::either);
}

} // namespace sahl::bench

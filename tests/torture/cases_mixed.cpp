// Meshes and exact shapes in one scene: on, in and beside each other, thin, far, mirrored, as instances; with
// rays along what they have in common.
#include "torture/aim.h"
#include "torture/cases.h"
#include "torture/parts.h"

#include <numbers>

namespace sahl::bench {

namespace {

/// Rays along the lines and planes through a place that bodies have in common there, a picometre and more
/// beside them.
RayOf along_axes(Affine const& group, dvec3 const& at, double size) {
    return [=](Dice& d, std::uint64_t k) {
        dvec3 p = at, direction(0.0);
        int const axis = static_cast<int>(d.below(3)), other = (axis + 1) % 3;
        p[axis] += size * d.between(-1, 1);
        p[other] += d.sign() * d.log_between(1e-12, 1e-2) * size;
        p[(axis + 2) % 3] += d.sign() * d.log_between(1e-12, 1e-2) * size;
        direction[axis] = d.sign();
        if (k % 2) // in a plane, not along an edge
            direction[other] = d.sign() * d.between(0.1, 1.0);
        return through(group, p, normalize(direction), 3.0 * size);
    };
}

/// Glass that stands in water and holds a liquid with a bubble at its wall: exact, mesh, exact.
void add_vessel(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Affine const group = group_of(1, variant);
    add(cases, "liquid as a mesh in exact glass in water, a bubble at its wall", {1.33, 1.5, 1.36, 1.0},
        {exact_block(dvec3(-0.15), dvec3(0.15), 1, group),
         {block({-0.1, -0.1, -0.12}, {0.1, 0.1, 0.15}), 2, group},
         exact_block({-0.1, -0.02, -0.12}, {-0.04, 0.04, -0.05}, 3, group)},
        group, anywhere(group, dvec3(-0.03, 0.0, -0.02), dvec3(0.22), 0.4));
}

void add_checkered_stack(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Affine const group = group_of(2, variant);
    std::vector<TorturePart> parts;
    for (std::uint32_t k = 0; k < 8; ++k) {
        dvec3 const low(k & 1 ? 0.0 : -1.0, k & 2 ? 0.0 : -1.0, k & 4 ? 0.0 : -1.0);
        bool const mesh = (k ^ (k >> 1) ^ (k >> 2)) & 1;
        if (mesh)
            parts.push_back({block(low, low + 1.0, k % 3 == 0), k + 1, group});
        else
            parts.push_back(exact_block(low, low + 1.0, k + 1, group));
    }
    std::vector<double> const indices{1.0, 1.5, 1.6, 1.7, 1.8, 1.55, 1.65, 1.75, 1.85};
    add(cases, "a stack of cubes, exact and meshes by turns", indices, parts, group,
        anywhere(group, dvec3(0.0), dvec3(1.8), 3.0));
    add(cases, "along the edges of that stack", indices, parts, group, along_axes(group, dvec3(0.0), 0.9),
        Rule::straight, false);
}

/// Twenty-seven of one mesh, touching: more than are asked one by one; some of them mirrored.
void add_instances(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Affine const group = group_of(3, variant);
    MeshRef const one = block(dvec3(-0.5), dvec3(0.5));
    std::vector<TorturePart> parts;
    std::vector<double> indices{1.0};
    for (std::uint32_t k = 0; k < 27; ++k) {
        dvec3 const at(k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0);
        dmat3 turn(1.0);
        if (k % 2)
            turn = dmat3({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}); // mirrored
        else if (k % 4 == 0)
            turn = dmat3({0, 1, 0}, {-1, 0, 0}, {0, 0, 1}); // a quarter turn: other diagonals
        parts.push_back({one, k + 1, compose(group, Affine{turn, at})});
        indices.push_back(1.3 + 0.02 * k);
    }
    add(cases, "instances that touch, every other one mirrored", indices, parts, group,
        anywhere(group, dvec3(0.0), dvec3(2.8), 4.0));
    parts.resize(14);
    for (std::uint32_t k = 14; k < 27; ++k)
        parts.push_back(
            {Box{dvec3(1.0)}, k + 1, moved_by(group, dvec3(k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0))});
    add(cases, "instances of a mesh among exact boxes", indices, parts, group,
        anywhere(group, dvec3(0.0), dvec3(2.8), 4.0));
}

/// Two blocks about a wedge of air that is 1e-7 rad wide, and a wedge of glass as sharp as that.
void add_wedges(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Affine const group = group_of(4, variant);
    double const angle = variant ? Dice(variant).log_between(1e-8, 1e-4) : 1e-7, c = std::cos(angle),
                 s = std::sin(angle);
    Affine const tilted = compose(group, Affine{dmat3({c, 0, s}, {0, 1, 0}, {-s, 0, c}), dvec3(0.0)});
    add(cases, "a thin wedge of air between an exact block and a mesh", {1.0, 1.5, 1.7},
        {exact_block({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.0}, 1, group),
         {block({0.0, -0.2, 0.0}, {0.2, 0.2, 0.2}), 2, tilted}},
        group, anywhere(group, {0.1, 0.0, 0.0}, {0.2, 0.3, 0.02}, 0.5));
    TriangleSoup soup = box_soup({0.0, -0.2, 0.0}, {0.2, 0.2, 1.0});
    for (dvec3& p : soup.positions) // blunt by a picometre: thinner than rounding it would be nothing
        p.z = p.z > 0.0 ? 1e-12 + angle * p.x : 0.0;
    add(cases, "a thin wedge of glass on an exact block", {1.0, 1.5, 1.7},
        {exact_block({-0.2, -0.2, -0.2}, {0.25, 0.2, 0.0}, 1, group), {mesh_of(std::move(soup)), 2, group}},
        group, anywhere(group, {0.1, 0.0, 0.0}, {0.2, 0.3, 1e-3}, 0.5));
}

/// A plate, or a gap, of a nanometre and less between two blocks.
void add_films(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Affine const group = group_of(5, variant);
    double const thick = variant ? Dice(variant).log_between(1e-11, 1e-7) : 1e-9;
    TorturePart const low = exact_block({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.0}, 1, group);
    RayOf const rays = anywhere(group, dvec3(0.0), {0.3, 0.3, 0.0}, 0.5);
    add(cases, "a film of a nanometre between a block and a mesh", {1.0, 1.5, 1.7, 1.4},
        {low,
         {block({-0.2, -0.2, 0.0}, {0.2, 0.2, thick}), 3, group},
         {block({-0.15, -0.2, thick}, {0.2, 0.15, 0.2}, true), 2, group}},
        group, rays);
    add(cases, "a gap of a nanometre between a block and a mesh", {1.0, 1.5, 1.7},
        {low, {block({-0.15, -0.2, thick}, {0.2, 0.15, 0.2}), 2, group}}, group, rays);
    add(cases, "a block and a mesh that overlap by a nanometre", {1.0, 1.5, 1.7},
        {low, {block({-0.15, -0.2, -thick}, {0.2, 0.15, 0.2}), 2, group}}, group, rays);
}

/// In contact far away, stretched, and small beside what it lies on.
void add_places(std::vector<TortureCase>& cases, std::uint64_t variant) {
    auto const pair = [](Affine const& group) {
        return std::vector<TorturePart>{{block({-0.15, -0.15, -0.1}, {0.15, 0.15, 0.0}), 1, group},
                                        exact_block({-0.1, -0.1, 0.0}, {0.1, 0.1, 0.2}, 2, group)};
    };
    RayOf (*const about)(Affine const&, dvec3 const&, dvec3 const&, double) = anywhere;
    Affine const far = group_of(6, variant, 1e4);
    add(cases, "a block on a mesh, 1e5 sizes away", {1.0, 1.5, 1.7}, pair(far), far,
        about(far, dvec3(0.0), dvec3(0.2), 1.0));
    Affine stretched = group_of(7, variant);
    stretched.linear = stretched.linear * dmat3({1e-2, 0, 0}, {0, 1.0, 0}, {0, 0, -3.0});
    add(cases, "a block on a mesh, stretched and mirrored", {1.0, 1.5, 1.7}, pair(stretched), stretched,
        about(stretched, dvec3(0.0), dvec3(0.2), 1.0));
    Affine const group = group_of(8, variant);
    add(cases, "a bead of ten micrometres on a block of a metre", {1.0, 1.5, 1.7},
        {exact_block(dvec3(-1.0), {1.0, 1.0, 0.0}, 1, group),
         {block({0.1, 0.2, 0.0}, {0.10001, 0.20001, 1e-5}), 2, group}},
        group, about(group, {0.100005, 0.200005, 2e-6}, dvec3(1.4e-5), 1e-3));
}

/// Near the critical angle at a contact; born on a contact; between equal media.
void add_contacts(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Affine const group = group_of(9, variant);
    double const n1 = 1.7, n2 = variant ? Dice(variant).between(1.2, 1.69) : 1.5;
    std::vector<TorturePart> const parts{exact_block({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.0}, 1, group),
                                         {block({-0.2, -0.2, 0.0}, {0.2, 0.2, 0.2}, true), 2, group}};
    double const critical = std::asin(n2 / n1);
    add(cases, "near the critical angle where a mesh touches a block", {1.0, n1, n2}, parts, group,
        [=](Dice& d, std::uint64_t) {
            double const a = critical + d.sign() * d.log_between(1e-15, 1e-3), turn = 6.2831853 * d.uniform();
            return through(group, {d.between(-0.1, 0.1), d.between(-0.1, 0.1), 0.0},
                           {std::sin(a) * std::cos(turn), std::sin(a) * std::sin(turn), std::cos(a)}, 0.05);
        });
    add(cases, "born where a mesh touches a block", {1.0, n1, n2}, parts, group, [=](Dice& d, std::uint64_t) {
        dvec3 const normal(0.0, 0.0, d.sign());
        TortureRay ray = through(group, {d.between(-0.19, 0.19), d.between(-0.19, 0.19), 0.0},
                                 along_surface(normal, d.log_between(1e-6, 1.5), d), 0.0);
        ray.part = 0;
        ray.face = 5; // front
        return ray;
    });
    add(cases, "a mesh in a block of the same index", {1.0, 1.5, 1.5, 1.7},
        {exact_block(dvec3(-0.2), dvec3(0.2), 1, group),
         {block({-0.2, -0.1, -0.1}, {0.1, 0.1, 0.2}), 2, group},
         {Sphere{0.05}, 3, moved_by(group, {0.0, 0.0, 0.15}), 1}},
        group, anywhere(group, dvec3(0.0), dvec3(0.4), 0.6));
}

/// The same body three times over, as a mesh, exact, and as a mesh of other diagonals; and boxes one in the
/// other with a corner in common.
void add_repeated(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Affine const group = group_of(10, variant);
    for (int const middle : {0, 1})
        add(
            cases, middle ? "one place three times, the exact one above" : "one place three times",
            {1.0, 1.5, 1.6, 1.7},
            {{block(dvec3(-0.1), dvec3(0.1)), 1, group},
             exact_block(dvec3(-0.1), dvec3(0.1), 2, group, middle),
             {block(dvec3(-0.1), dvec3(0.1), true), 3, group}},
            group,
            [=](Dice& d, std::uint64_t) {
                // not at edges or diagonals: there each has its own start within rounding, of which the judge
                // takes one
                dvec3 const at = of_box(dvec3(-0.1), dvec3(0.1), d, 0);
                return through(group, at, d.direction(), 0.5);
            },
            Rule::either, false);
    std::vector<TorturePart> nested;
    for (std::uint32_t k = 0; k < 6; ++k) {
        dvec3 const high(0.7 - 0.1 * k);
        if (k % 2)
            nested.push_back({block(dvec3(0.0), high, k % 3 == 0), k + 1, group});
        else
            nested.push_back(exact_block(dvec3(0.0), high, k + 1, group));
    }
    add(cases, "six boxes with a corner in common", {1.0, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9}, nested, group,
        [=](Dice& d, std::uint64_t k) {
            dvec3 p(d.uniform() * 0.6, d.uniform() * 0.6, d.uniform() * 0.6);
            if (k % 2)
                p[static_cast<int>(k / 2 % 3)] = 0.0;
            return through(group, p, d.direction(), 2.0);
        });
}

/// Bodies that have only a corner or an edge in common, and a rod that lies on a mesh.
void add_corners(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Affine const group = group_of(11, variant);
    for (bool edge : {true, false}) {
        dvec3 const high(1.0, 1.0, edge ? 0.0 : 1.0);
        std::vector<TorturePart> const parts{exact_block(dvec3(-1.0), dvec3(0.0), 1, group),
                                             {block(high - 1.0, high), 2, group}};
        add(
            cases, edge ? "an edge in common" : "a corner in common", {1.0, 1.5, 1.7}, parts, group,
            [=](Dice& d, std::uint64_t) {
                dvec3 const at(d.sign() * d.log_between(1e-10, 1e-1), d.sign() * d.log_between(1e-10, 1e-1),
                               edge ? -d.uniform() : d.sign() * d.log_between(1e-10, 1e-1));
                return through(group, at, d.direction(), 3.0);
            },
            Rule::either, false);
    }
    TortureCase rod{"a rod on a mesh's block", "mixed", {1.0, 1.5, 1.7}, {}, {}};
    Affine const lying{dmat3({0, 1, 0}, {0, 0, 1}, {1, 0, 0}), {0.0, 0.0, 0.05}};
    rod.parts = {{block({-0.2, -0.2, -0.1}, {0.2, 0.2, 0.0}), 1, group},
                 {Cylinder{0.05, 0.3}, 2, compose(group, lying)}};
    rod.ray = [=](Dice& d, std::uint64_t) { // as near as the gap, y²/2R, is above the rounding
        return through(group, {d.between(-0.14, 0.14), d.sign() * d.log_between(3e-5, 0.05), 0.0},
                       normalize(dvec3(0.0, 0.0, d.sign()) + 0.01 * d.direction()), 0.3);
    };
    cases.push_back(std::move(rod));
}

/// Lenses: a plane face on a mesh, an exact face on a mesh's facets (between which are slivers of gap and
/// overlap), clad rods, a prism in half a cube.
void add_optics(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Affine const group = group_of(12, variant);
    add(cases, "a plano-convex lens on a mesh's block", {1.0, 1.5, 1.7},
        {{block({-0.02, -0.02, -0.01}, {0.02, 0.02, 0.0}), 1, group},
         {Lens{0.0, -0.05, 4e-3, 0.02}, 2, group}},
        group, anywhere(group, dvec3(0.0), {0.024, 0.024, 8e-3}, 0.05));
    auto const around = static_cast<std::uint32_t>(variant ? 5 + Dice(variant).below(30) : 24);
    for (int const priority : {0, 1}) {
        add(cases,
            priority ? "an exact lens on a mesh's facets, above it" : "an exact lens on a mesh's facets",
            {1.0, 1.5168, 1.67271},
            {{Lens{61.47e-3, -44.64e-3, 6e-3, 25e-3}, 1, group, priority},
             {mesh_of(lens_soup(-44.64e-3, -129.94e-3, 6e-3, 2.5e-3, 12.5e-3, 8, around)), 2, group}},
            group, anywhere(group, {0.0, 0.0, 4e-3}, {0.02, 0.02, 0.01}, 0.05));
    }
    add(cases, "two lenses whose facets differ", {1.0, 1.5168, 1.67271},
        {{mesh_of(lens_soup(61.47e-3, -44.64e-3, 0.0, 6e-3, 12.5e-3, 7, around + 3)), 1, group},
         {mesh_of(lens_soup(-44.64e-3, -129.94e-3, 6e-3, 2.5e-3, 12.5e-3, 8, around)), 2, group}},
        group, anywhere(group, {0.0, 0.0, 4e-3}, {0.02, 0.02, 0.01}, 0.05));
    add(cases, "a clad rod on a mesh's block", {1.0, 1.5, 1.7, 1.45},
        {{Cylinder{0.02, 0.1}, 3, moved_by(group, {0.0, 0.0, 0.05})},
         {Cylinder{0.015, 0.1}, 1, moved_by(group, {0.0, 0.0, 0.05})},
         {block({-0.1, -0.1, -0.05}, {0.1, 0.1, 0.0}), 2, group}},
        group, anywhere(group, {0.0, 0.0, 0.03}, {0.04, 0.04, 0.1}, 0.2));
}

/// Ten thousand reflections in a pipe of an exact and a mesh's half that touch all along.
void add_mixed_pipe(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Affine const group = group_of(13, variant);
    double const w = 5e-4;
    TortureCase made{"a light pipe of two halves, one a mesh", "mixed", {1.0, 1.5, 1.5}, {}, {}};
    made.parts = {exact_block({-w, -w, -1.0}, {0.0, w, 1.0}, 1, group),
                  {block({0.0, -w, -1.0}, {w, w, 1.0}), 2, group}};
    made.contact = rounding_of(group);
    made.rule = Rule::reflect;
    made.events = 10'000;
    made.share = 2e-4;
    made.ray = [=](Dice& d, std::uint64_t) {
        double const slant = d.log_between(1e-2, 0.8);
        return through(group,
                       {0.4 * w * d.between(-1, 1), 0.4 * w * d.between(-1, 1), 0.4 * d.between(-1, 1)},
                       normalize(dvec3(slant * d.between(-1, 1), slant * d.between(-1, 1), d.sign())), 0.0);
    };
    cases.push_back(std::move(made));
}

} // namespace

void add_mixed_cases(std::vector<TortureCase>& cases, std::uint64_t variant) {
    add_vessel(cases, variant);
    add_checkered_stack(cases, variant);
    add_instances(cases, variant);
    add_wedges(cases, variant);
    add_films(cases, variant);
    add_places(cases, variant);
    add_contacts(cases, variant);
    add_repeated(cases, variant);
    add_corners(cases, variant);
    add_optics(cases, variant);
    add_mixed_pipe(cases, variant);
}

} // namespace sahl::bench

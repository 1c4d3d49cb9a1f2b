// What works by itself, together: clipped quadrics, open surfaces, torn meshes, instances, priorities and
// contact in one scene; and scenes thrown together at random on a lattice.
#include "torture/cases.h"
#include "torture/parts.h"

namespace sahl::bench {

namespace {

/// A post through a plate. Rays start above the plate, closer to it than float tells, and run along it: into
/// the plate, and in it to the post.
void add_post_in_plate(std::vector<TortureCase>& cases, std::uint64_t variant, bool many) {
    Affine const group = group_of(20, variant);
    for (bool const exact : {false, true}) {
        TorturePart const post = exact ? exact_block({0.3, -0.1, -0.1}, {0.4, 0.1, 0.1}, 2, group, 1)
                                       : TorturePart{block({0.3, -0.1, -0.1}, {0.4, 0.1, 0.1}), 2, group, 1};
        std::vector<TorturePart> parts{{block({-0.5, -0.5, -0.2}, {0.5, 0.5, 0.0}), 1, group}, post};
        for (std::uint32_t k = 0; many && k < 7; ++k) // then they are found by a tree of boxes
            parts.push_back({block(dvec3(0.0, 0.0, 1.0 + k), dvec3(0.5, 0.5, 1.5 + k)), 3, group});
        std::string const name = std::string("from close above a plate into it, to a ") +
                                 (exact ? "block" : "mesh") + " in it" + (many ? ", among others" : "");
        add(
            cases, name, {1.0, 1.5, 1.7, 1.6}, parts, group,
            [=](Dice& d, std::uint64_t) {
                double const height = d.log_between(1e-10, 1e-5);
                dvec3 const at(d.between(-0.4, 0.25), d.between(-0.09, 0.09), height);
                double const run = (0.3 - at.x) * d.between(0.1, 0.9); // well before the post
                return through(group, at, normalize(dvec3(run, 0.1 * run * d.between(-1, 1), -height)), 0.0);
            },
            Rule::straight); // refracted, all would come to the far face at the critical angle
    }
}

/// A plate in a block of higher priority. Rays start in both, close below the plate's top, and leave it along
/// it.
void add_plate_in_block(std::vector<TortureCase>& cases, std::uint64_t variant, bool many) {
    Affine const group = group_of(24, variant);
    std::vector<TorturePart> parts{{block({-0.5, -0.5, -0.2}, {0.5, 0.5, 0.0}), 1, group},
                                   {block({-0.45, -0.45, -0.15}, {0.45, 0.45, 0.1}), 2, group, 1}};
    for (std::uint32_t k = 0; many && k < 7; ++k)
        parts.push_back({block(dvec3(0.0, 0.0, 1.0 + k), dvec3(0.5, 0.5, 1.5 + k)), 3, group});
    add(
        cases, std::string("out of a plate along its top, within a block") + (many ? ", among others" : ""),
        {1.0, 1.5, 1.7, 1.6}, parts, group,
        [=](Dice& d, std::uint64_t) {
            double const depth = d.log_between(1e-10, 1e-5), run = d.between(0.05, 0.4);
            dvec3 const at(d.between(-0.4, 0.0), d.between(-0.3, 0.3), -depth);
            return through(group, at, normalize(dvec3(run, 0.2 * run * d.between(-1, 1), depth)), 0.0);
        },
        Rule::straight);
}

/// A box as a mesh that lacks one triangle of its first side.
MeshRef torn_block(dvec3 const& low, dvec3 const& high) {
    TriangleSoup soup = box_soup(low, high);
    soup.triangles.pop_back();
    soup.triangle_face.pop_back();
    return mesh_of(std::move(soup));
}

TorturePart mirror(Shape shape, Affine const& place) {
    TorturePart part{std::move(shape), 0, place};
    part.mirror = true;
    return part;
}

/// Two triangles, their normals along +z.
TorturePart mirror_mesh(dvec2 const& low, dvec2 const& high, double z, Affine const& group) {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    soup.positions = {{low.x, low.y, z}, {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z}};
    add_triangle(soup, 0, 1, 2);
    add_triangle(soup, 0, 2, 3);
    TorturePart part{mesh_of(std::move(soup)), 0, group};
    part.mirror = true;
    return part;
}

/// An ellipsoid and a cone that are clipped, caps on a mesh's face, a liquid between them, and mirrors on
/// faces.
void add_clipped(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Affine const group = group_of(21, variant);
    double const h = 0.06; // half the height between its caps
    QuadricBody const barrel{{1 / 0.01, 1 / 0.0144, 1 / 0.01, 0, 0, 0, 0, 0, 0, -1}, {1.0, 1.0, 2.0 * h}};
    QuadricBody const waist{{1, 1, -0.5, 0, 0, 0, 0, 0, 0, -0.0016}, {0.4, 0.4, 0.1}};
    TorturePart const table{block({-0.3, -0.3, -0.1}, {0.3, 0.3, 0.0}), 1, group};
    std::vector<TorturePart> parts{table,
                                   {barrel, 2, moved_by(group, {0.0, 0.0, h})},
                                   {Cone{0.1, 0.02, 0.12}, 3, moved_by(group, {0.2, 0.0, 0.06})},
                                   {waist, 4, moved_by(group, {-0.2, 0.0, 0.05}), 1},
                                   exact_block({-0.3, -0.05, 0.0}, {0.3, 0.05, 0.03}, 3, group)};
    std::vector<double> const indices{1.0, 1.5, 1.7, 1.33, 1.6};
    RayOf const rays = anywhere(group, {0.0, 0.0, 0.03}, {0.5, 0.25, 0.12}, 0.6);
    add(cases, "clipped quadrics and a cone on a mesh, in a liquid", indices, parts, group, rays);
    parts.push_back(mirror(Rectangle{{0.3, 0.2}}, moved_by(group, {0.05, 0.0, 0.0})));
    parts.push_back(mirror(Disk{0.05, 0.01}, moved_by(group, {0.0, 0.0, 2.0 * h})));
    parts.push_back(mirror_mesh({-0.3, -0.2}, {-0.1, 0.2}, -0.1, group));
    add(cases, "the same with mirrors on their faces", indices, parts, group, rays);
}

/// A mesh with a hole on an exact block, a ball in it, a mirror on its top: what finds the hole is a leak,
/// all else is as it would be.
void add_torn(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Affine const group = group_of(22, variant);
    TorturePart torn{torn_block({-0.1, -0.1, 0.0}, {0.1, 0.1, 0.15}), 1, group};
    torn.torn = true;
    add(cases, "a torn mesh on a block, with a ball in it and a mirror on it", {1.0, 1.5, 1.7, 1.6},
        {torn,
         exact_block({-0.2, -0.2, -0.1}, {0.2, 0.2, 0.0}, 2, group),
         {Sphere{0.04}, 3, moved_by(group, {0.0, 0.0, 0.07}), 1},
         mirror(Rectangle{{0.1, 0.2}}, moved_by(group, {0.05, 0.0, 0.15}))},
        group, anywhere(group, {0.0, 0.0, 0.05}, {0.25, 0.25, 0.25}, 0.5));
}

/// A glass of flat sides, and a liquid that fits it, cut in triangles at other heights, tilted.
void add_faceted_glass(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Affine const group = group_of(23, variant);
    auto const around = static_cast<std::uint32_t>(variant ? 5 + Dice(variant).below(20) : 12);
    auto const wall = [](double radius, std::vector<double> const& heights) {
        std::vector<dvec2> outline{{0.0, heights.front()}};
        for (double const z : heights)
            outline.push_back({radius, z});
        outline.push_back({0.0, heights.back()});
        return outline;
    };
    std::vector<dvec2> glass = wall(0.05, {0.0, 0.03, 0.12});
    glass.pop_back();
    for (dvec2 const& p : {dvec2(0.04, 0.12), dvec2(0.04, 0.01), dvec2(0.0, 0.01)})
        glass.push_back(p);
    add(cases, "a liquid in a faceted glass, cut otherwise", {1.0, 1.5, 1.33, 1.6},
        {{mesh_of(revolved(glass, around)), 1, group},
         {mesh_of(revolved(wall(0.04, {0.01, 0.025, 0.05, 0.08}), around)), 2, group},
         {Sphere{0.01}, 3, moved_by(group, {0.0, 0.0, 0.02})}},
        group, anywhere(group, {0.0, 0.0, 0.06}, {0.1, 0.1, 0.12}, 0.3));
}

/// A body on a lattice of cells, one of many kinds: flat faces, edges and corners fall on those of others.
/// What is round is tangent to nothing: there the gap is less than rounding over a width that is not small.
TorturePart on_lattice(Dice& dice, MeshRef const& unit, std::uint32_t media, Affine const& group,
                       bool with_mirrors) {
    auto const whole = [&](std::uint64_t count) { return static_cast<double>(dice.below(count)); };
    dvec3 const low(whole(4), whole(4), whole(4)), size(1.0 + whole(2), 1.0 + whole(2), 1.0 + whole(2));
    auto const medium = static_cast<std::uint32_t>(1 + dice.below(media));
    int const priority = static_cast<int>(dice.below(3));
    auto const at = [&](Shape shape, dvec3 const& centre) {
        return TorturePart{std::move(shape), medium, moved_by(group, centre), priority};
    };
    dvec3 const half_steps(0.5 * whole(9), 0.5 * whole(9), 0.5 * whole(9));
    switch (dice.below(with_mirrors ? 11 : 9)) {
    case 0:
        return exact_block(low, low + size, medium, group, priority);
    case 1:
        return {mesh_of(grid_box_soup(static_cast<std::uint32_t>(1 + dice.below(3)))), medium,
                compose(group, Affine{0.5 * dmat3({size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}),
                                      low + 0.5 * size}),
                priority};
    case 2:
        return {block(low, low + size, dice.below(2) == 0), medium, group, priority};
    case 3: { // an instance, scaled, turned by quarters, mirrored
        dmat3 turn(0.0);
        std::uint64_t const first = dice.below(3), second = (first + 1 + dice.below(2)) % 3;
        for (std::uint64_t const k : {std::uint64_t(0), std::uint64_t(1), std::uint64_t(2)}) {
            std::uint64_t const axis = k == 0 ? first : k == 1 ? second : 3 - first - second;
            turn[static_cast<int>(k)][static_cast<int>(axis)] =
                0.5 * dice.sign() * size[static_cast<int>(axis)];
        }
        return {unit, medium, compose(group, Affine{turn, low + 0.5 * size}), priority};
    }
    case 4:
        return at(Sphere{0.5 * whole(3) + 0.63}, half_steps);
    case 5:
        return at(Cylinder{0.5 * whole(3) + 0.63, size.z},
                  low + dvec3(0.5 * whole(2), 0.5 * whole(2), 0.5 * size.z));
    case 6:
        return at(Lens{dice.below(2) ? 0.0 : 3.0, -2.0, 0.75, 1.9}, low);
    case 7:
        return at(Cone{0.93, 0.47 * whole(3), size.z}, low + dvec3(1.0, 1.0, 0.5 * size.z));
    case 8:
        return at(QuadricBody{{0.9, 0.5, 0.9, 0, 0, 0, 0, 0, 0, -1}, {size.x, size.y, 1.0}}, half_steps);
    case 9:
        return mirror(Rectangle{{size.x, size.y}}, moved_by(group, low));
    default:
        return mirror_mesh({low.x, low.y}, {low.x + size.x, low.y + size.y}, low.z, group);
    }
}

/// Scenes thrown together at random: what touches, nests, overlaps, and in which order, is left to chance.
void add_crowd(std::vector<TortureCase>& cases, std::uint64_t variant, std::uint64_t number) {
    Dice dice(1000 + 100 * variant + number);
    Affine group{dice.rotation(), 3.0 * dice.direction()};
    if (number % 4 == 0)
        group = Affine{};
    group.linear = (number % 3 == 2 ? 1e-3 : 1.0) * group.linear;
    std::uint32_t const media = 4;
    std::vector<double> indices{1.0};
    for (std::uint32_t k = 0; k < media; ++k)
        indices.push_back(dice.between(1.1, 1.9));
    MeshRef const unit = mesh_of(grid_box_soup(2));
    std::vector<TorturePart> parts;
    for (std::uint64_t k = 0, count = 3 + dice.below(number % 2 ? 4 : 12); k < count; ++k)
        parts.push_back(on_lattice(dice, unit, media, group, number >= 4));
    add(cases, "a crowd on a lattice, " + std::to_string(number), indices, parts, group,
        [=](Dice& d, std::uint64_t k) {
            dvec3 at = d.in_box(dvec3(0.0), dvec3(5.0)), direction = d.direction();
            if (k % 3 == 1) // beside a lattice's point
                for (int axis = 0; axis < 3; ++axis)
                    at[axis] = std::round(at[axis]) +
                               d.sign() * d.log_between(1e-5, 1e-1); // where two are tangent, a gap
            if (k % 6 >= 4) {
                // along an axis, all but: a ball would turn all of those exactly into an edge through its
                // centre
                direction *= d.log_between(1e-6, 1e-2);
                direction[static_cast<int>(d.below(3))] += d.sign();
                direction = normalize(direction);
            }
            return through(group, at, direction, k % 5 == 0 ? 0.0 : 12.0);
        });
}

} // namespace

void add_combined_cases(std::vector<TortureCase>& cases, std::uint64_t variant) {
    for (bool const many : {false, true})
        add_post_in_plate(cases, variant, many);
    for (bool const many : {false, true})
        add_plate_in_block(cases, variant, many);
    add_clipped(cases, variant);
    add_torn(cases, variant);
    add_faceted_glass(cases, variant);
    for (std::uint64_t number = 0; number < 8; ++number)
        add_crowd(cases, variant, number);
}

} // namespace sahl::bench

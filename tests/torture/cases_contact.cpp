// Bodies that touch, nest and overlap: blocks, prisms, cemented lenses, liquid in a glass.
#include "torture/aim.h"
#include "torture/cases.h"

#include <numbers>

namespace sahl::bench {

namespace {

constexpr double air = 1.0, crown = 1.5, flint = 1.7, water = 1.33;

Affine moved_by(Affine const& group, dvec3 const& offset) {
    return compose(group, Affine{dmat3(1.0), offset});
}

/// How far apart faces may come to lie that were placed to touch: a few roundings of the coordinates.
double rounding_of(Affine const& group) {
    return 1e-14 * (1.0 + length(group.offset));
}

TortureRay at_random(Affine const& group, dvec3 const& middle, dvec3 const& size, double before, Dice& d) {
    dvec3 const p = middle + 0.5 * size * dvec3(d.between(-1, 1), d.between(-1, 1), d.between(-1, 1));
    return through(group, p, d.direction(), before);
}

/// Kinds: 0 exact on exact, 1 mesh on mesh with other diagonals, 2 mesh on exact.
void add_blocks(std::vector<TortureCase>& cases, Affine const& group, int kind, std::string const& where) {
    TortureCase made{"block on block" + where, kind == 0 ? "exact" : "mesh", {air, crown, flint}, {}, {}};
    if (kind == 2)
        made.name = "a mesh's block on an exact one" + where;
    dvec3 const lower(0.3, 0.3, 0.1), upper(0.2, 0.2, 0.2);
    if (kind == 1)
        made.parts.push_back({mesh_of(box_soup({-0.15, -0.15, -0.1}, {0.15, 0.15, 0.0})), 1, group});
    else
        made.parts.push_back({Box{lower}, 1, moved_by(group, {0.0, 0.0, -0.05})});
    if (kind == 0)
        made.parts.push_back({Box{upper}, 2, moved_by(group, {0.0, 0.0, 0.1})});
    else
        made.parts.push_back({mesh_of(box_soup({-0.1, -0.1, 0.0}, {0.1, 0.1, 0.2}, true)), 2, group});
    made.contact = rounding_of(group);
    made.ray = [=](Dice& d, std::uint64_t k) {
        dvec3 at(d.between(-0.14, 0.14), d.between(-0.14, 0.14), 0.0);
        if (k % 4 == 0)
            at.y = k % 8 ? at.x : -at.x; // a diagonal
        return through(group, at, d.direction(), 1.0);
    };
    cases.push_back(std::move(made));
}

/// Two 45° prisms, hypotenuses facing, light that comes at 45° to the gap.
void add_prisms(std::vector<TortureCase>& cases, std::uint64_t variant, double gap, bool exact,
                dvec3 const& where) {
    Dice dice(700 + variant);
    Affine const group{variant ? dice.rotation() : dmat3(1.0), where};
    TortureCase made{gap == 0.0 ? "two prisms in contact, a metre away"
                                : "two prisms a micrometre apart, a metre away",
                     exact ? "exact" : "mesh",
                     {air, crown, crown},
                     {},
                     {}};
    double const side = 0.02;
    if (exact) {
        double const quarter = std::numbers::pi / 2.0, height = 0.5 * side * std::cos(0.5 * quarter);
        Prism const prism{quarter, side, side};
        Affine const turned{dmat3({-1, 0, 0}, {0, -1, 0}, {0, 0, 1}), {0.0, -2.0 * height - gap, 0.0}};
        made.parts = {{prism, 1, group}, {prism, 2, compose(group, turned)}};
        made.ray = [=](Dice& d, std::uint64_t) { // through the left face, at right angles but for a little
            dvec3 const on_base(0.4 * side * d.between(-1, 1), -height, 0.4 * side * d.between(-1, 1));
            return through(group, on_base, normalize(dvec3(1.0, -1.0, 0.0) + 0.02 * d.direction()), 0.1);
        };
    } else {
        made.parts = {{mesh_of(half_cube(side, false, 0.0, false)), 1, group},
                      {mesh_of(half_cube(side, true, gap / std::sqrt(2.0), true)), 2, group}};
        made.ray = [=](Dice& d, std::uint64_t k) {
            double const x = side * (k % 5 ? d.between(0.1, 0.9) : 0.5);
            return through(group, {x, x, 0.4 * side * d.between(-1, 1)},
                           normalize(dvec3(-1.0, 0.0, 0.0) + 0.02 * d.direction()), 0.1);
        };
    }
    made.rule = Rule::transmit;
    made.contact = gap == 0.0 ? rounding_of(group) : 0.0;
    cases.push_back(std::move(made));
}

void add_doublet(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact) {
    Dice dice(800 + variant);
    Affine const group = variant ? Affine{dice.rotation(), dice.direction()} : Affine{};
    double const r1 = variant ? dice.between(40e-3, 80e-3) : 61.47e-3,
                 r2 = variant ? -dice.between(30e-3, 60e-3) : -44.64e-3,
                 r3 = variant ? -dice.between(90e-3, 200e-3) : -129.94e-3, rim = 12.5e-3;
    TortureCase made{"a cemented doublet", exact ? "exact" : "mesh", {air, 1.5168, 1.67271}, {}, {}};
    auto const steps = static_cast<std::uint32_t>(variant ? 5 + dice.below(12) : 10),
               around = static_cast<std::uint32_t>(variant ? 8 + dice.below(40) : 32);
    if (exact)
        made.parts = {{Lens{r1, r2, 6e-3, 2.0 * rim}, 1, group},
                      {Lens{r2, r3, 2.5e-3, 2.0 * rim}, 2, moved_by(group, {0.0, 0.0, 6e-3})}};
    else
        made.parts = {{mesh_of(lens_soup(r1, r2, 0.0, 6e-3, rim, steps, around)), 1, group},
                      {mesh_of(lens_soup(r2, r3, 6e-3, 2.5e-3, rim, steps, around)), 2, group}};
    made.contact = 1e-15 * (1.0 + length(group.offset));
    made.ray = [=](Dice& d, std::uint64_t k) {
        dvec3 const p(0.6 * rim * d.between(-1, 1), 0.6 * rim * d.between(-1, 1), 4e-3);
        return through(
            group, p,
            k % 2 ? dvec3(0.0, 0.0, 1.0) : normalize(dvec3(0.0, 0.0, d.sign()) + 0.3 * d.direction()), 0.05);
    };
    cases.push_back(std::move(made));
}

/// A tumbler with water in it: the liquid's wall is that of the glass, or lies a little way inside the glass,
/// which has the higher priority there.
void add_tumbler(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact, bool overlapping) {
    Dice dice(900 + variant);
    Affine const group = variant ? Affine{dice.rotation(), dice.direction()} : Affine{};
    double const outer = 0.035, bore = variant ? dice.between(0.02, 0.033) : 0.03, level = 0.02,
                 over = overlapping ? 0.5e-3 : 0.0;
    auto const around = static_cast<std::uint32_t>(variant ? 8 + dice.below(40) : 32);
    TortureCase made{overlapping ? "liquid that overlaps its glass" : "liquid that fits its glass",
                     exact ? "exact" : "mesh",
                     {air, crown, water, air},
                     {},
                     {}};
    if (exact) {
        // the glass is a rod, bored: the bore is a body of air, the water in it comes last
        made.parts = {{Cylinder{outer, 0.1}, 1, group, overlapping ? 1 : 0},
                      {Cylinder{bore, 0.09}, 3, moved_by(group, {0.0, 0.0, 0.005}), overlapping ? 2 : 0},
                      {Cylinder{bore + over, 0.06 + over}, 2, moved_by(group, {0.0, 0.0, -0.01 - 0.5 * over}),
                       overlapping ? 0 : 0}};
        if (overlapping) // water may not drive out the bore's air: it is what the bore is filled with up to
                         // the level
            made.parts = {{Cylinder{outer, 0.1}, 1, group, 1},
                          {Cylinder{bore, 0.06}, 2, moved_by(group, {0.0, 0.0, -0.01}), 2},
                          {Cylinder{bore + over, 0.04}, 3, moved_by(group, {0.0, 0.0, 0.04 - over}), 0}};
    } else {
        made.parts = {
            {mesh_of(revolved({{0.0, -0.05},
                               {outer, -0.05},
                               {outer, 0.05},
                               {bore, 0.05},
                               {bore, level},
                               {bore, -0.04},
                               {0.0, -0.04}},
                              around)),
             1, group, 1},
            {mesh_of(revolved(
                 {{0.0, -0.04 - over}, {bore + over, -0.04 - over}, {bore + over, level}, {0.0, level}},
                 around)),
             2, group, 0}};
    }
    made.contact = rounding_of(group);
    made.ray = [=](Dice& d, std::uint64_t) {
        return at_random(group, dvec3(0.0), {0.06, 0.06, 0.1}, 0.2, d);
    };
    cases.push_back(std::move(made));
}

void add_nested(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact) {
    Dice dice(1000 + variant);
    Affine const group{variant ? dice.rotation() : dmat3(1.0), variant ? dice.direction() : dvec3(0.0)};
    double const inner = variant ? dice.between(0.3, 0.9) : 0.8;
    TortureCase made{
        "liquid in a glass ball in water", exact ? "exact" : "mesh", {water, crown, 1.36, air}, {}, {}};
    auto const ball = [&](double radius) -> std::variant<Shape, MeshRef> {
        if (exact)
            return Sphere{radius};
        return mesh_of(ball_soup(radius, 2));
    };
    // the liquid's ball is the hole's: the later one counts
    made.parts = {{ball(1.0), 1, group},
                  {ball(inner), 3, group},
                  {ball(inner), 2, group},
                  {ball(0.1 * inner), 3, group}};
    made.contact = rounding_of(group);
    made.ray = [=](Dice& d, std::uint64_t) { return at_random(group, dvec3(0.0), dvec3(1.4), 3.0, d); };
    cases.push_back(std::move(made));
}

void add_matched(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact) {
    Dice dice(1100 + variant);
    Affine const group = variant ? Affine{dice.rotation(), dice.direction()} : Affine{};
    double const n = variant ? dice.between(1.0, 3.0) : crown;
    TortureCase made{"index-matched bodies", exact ? "exact" : "mesh", {1.0, n, n, n}, {}, {}};
    auto const box = [&](dvec3 const& half, bool other) -> std::variant<Shape, MeshRef> {
        if (exact)
            return Box{2.0 * half};
        return mesh_of(box_soup(-half, half, other));
    };
    // one in another, and one that overlaps both and is flush with the outer one's top
    made.parts = {{box(dvec3(1.0), false), 1, group},
                  {box(dvec3(0.5), true), 2, moved_by(group, {0.1, 0.2, 0.3})},
                  {box(dvec3(0.75), true), 3, moved_by(group, {0.6, 0.0, 0.25}), 1}};
    made.contact = rounding_of(group);
    made.ray = [=](Dice& d, std::uint64_t) { return at_random(group, {0.3, 0.0, 0.0}, dvec3(2.0), 5.0, d); };
    cases.push_back(std::move(made));
}

/// A ball that touches a plate in one point, and rays close to it.
void add_ball_on_plate(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Dice dice(1200 + variant);
    Affine const group = variant ? Affine{dice.rotation(), dice.in_box(dvec3(-1.0), dvec3(1.0))} : Affine{};
    TortureCase made{"a ball on a plate", "exact", {air, crown, flint}, {}, {}};
    made.parts = {{Sphere{1.0}, 1, moved_by(group, {0.0, 0.0, 1.0})},
                  {Box{{3.0, 3.0, 0.2}}, 2, moved_by(group, {0.0, 0.0, -0.1})}};
    double const least =
        variant ? 1e-5 : 3e-6; // the gap there, r² / 2 R, is above the rounding of placing them
    made.ray = [=](Dice& d, std::uint64_t) {
        double const r = d.log_between(least, 0.5), a = 2.0 * std::numbers::pi * d.uniform();
        dvec3 const direction = normalize(dvec3(0.0, 0.0, d.sign()) + 0.1 * std::min(0.1, r) * d.direction());
        return through(group, {r * std::cos(a), r * std::sin(a), 0.0}, direction, 3.0);
    };
    made.rule = Rule::transmit;
    cases.push_back(std::move(made));
}

void add_lens_on_plate(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact) {
    Dice dice(1300 + variant);
    Affine const group = variant ? Affine{dice.rotation(), dice.direction()} : Affine{};
    double const rim = 0.01, radius = variant ? dice.between(0.02, 0.2) : 0.05;
    TortureCase made{"a plano-convex lens on a plate", exact ? "exact" : "mesh", {air, crown, flint}, {}, {}};
    if (exact)
        made.parts = {{Lens{0.0, -radius, 4e-3, 2.0 * rim}, 1, group},
                      {Box{{0.1, 0.1, 0.01}}, 2, moved_by(group, {0.0, 0.0, -5e-3})}};
    else
        made.parts = {{mesh_of(lens_soup(0.0, -radius, 0.0, 4e-3, rim, 6, 24)), 1, group},
                      {mesh_of(box_soup({-0.05, -0.05, -0.01}, {0.05, 0.05, 0.0})), 2, group}};
    made.contact = rounding_of(group);
    made.ray = [=](Dice& d, std::uint64_t) {
        return at_random(group, dvec3(0.0), {0.024, 0.024, 0.008}, 0.05, d);
    };
    cases.push_back(std::move(made));
}

/// Two by two by two cubes of different glass, and rays that pass close to the lines where four of them meet.
void add_stack(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact) {
    Dice dice(1310 + variant);
    Affine const group = variant ? Affine{dice.rotation(), dice.direction()} : Affine{};
    TortureCase made{"a stack of cubes",
                     exact ? "exact" : "mesh",
                     {air, 1.5, 1.6, 1.7, 1.8, 1.55, 1.65, 1.75, 1.85},
                     {},
                     {}};
    for (std::uint32_t k = 0; k < 8; ++k) {
        dvec3 const at(k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5);
        if (exact)
            made.parts.push_back({Box{dvec3(1.0)}, k + 1, moved_by(group, at)});
        else
            made.parts.push_back({mesh_of(box_soup(at - 0.5, at + 0.5, k % 3 == 0)), k + 1, group});
    }
    made.contact = rounding_of(group);
    made.ray = [=](Dice& d, std::uint64_t k) {
        dvec3 p(d.between(-0.9, 0.9), d.between(-0.9, 0.9), d.between(-0.9, 0.9));
        if (k % 2)
            p[static_cast<int>(k / 2 % 3)] = d.log_between(1e-8, 1e-2);
        if (k % 4 == 3)
            p[static_cast<int>((k / 2 + 1) % 3)] = d.log_between(1e-8, 1e-2);
        return through(group, p, d.direction(), k % 5 ? 3.0 : 0.3);
    };
    cases.push_back(std::move(made));
}

/// Two blocks whose touching faces lie askew in their plane.
void add_askew(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact) {
    Dice dice(1320 + variant);
    Affine const group = variant ? Affine{dice.rotation(), dice.direction()} : Affine{};
    double const angle = variant ? dice.between(0.1, 1.5) : 0.5, c = std::cos(angle), s = std::sin(angle);
    Affine const upper = compose(group, Affine{dmat3({c, s, 0}, {-s, c, 0}, {0, 0, 1}), {0.1, -0.05, 0.25}}),
                 lower = moved_by(group, {0.0, 0.0, -0.25});
    TortureCase made{"blocks askew", exact ? "exact" : "mesh", {air, crown, flint}, {}, {}};
    MeshRef const mesh = mesh_of(box_soup(dvec3(-0.4, -0.3, -0.25), dvec3(0.4, 0.3, 0.25)));
    Box const box{{0.8, 0.6, 0.5}};
    if (exact)
        made.parts = {{box, 1, lower}, {box, 2, upper}};
    else
        made.parts = {{mesh, 1, lower}, {mesh, 2, upper}};
    made.contact = rounding_of(group);
    made.ray = [=](Dice& d, std::uint64_t) { return at_random(group, dvec3(0.0), {0.9, 0.7, 0.1}, 2.0, d); };
    cases.push_back(std::move(made));
}

/// A ball that sits in a lens hollowed for it, and one under another frame that touches nothing.
void add_ball_in_lens(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Dice dice(1330 + variant);
    Affine const group = variant ? Affine{dice.rotation(), dice.direction()} : Affine{};
    double const radius = variant ? dice.between(0.011, 0.02) : 0.012;
    TortureCase made{"a ball in a hollow lens", "exact", {air, crown, flint}, {}, {}};
    made.parts = {{Lens{0.0, radius, 2e-3, 0.02}, 1, group},
                  {Sphere{radius}, 2, moved_by(group, {0.0, 0.0, 2e-3 + radius})}};
    made.contact = rounding_of(group);
    made.ray = [=](Dice& d, std::uint64_t) {
        return at_random(group, {0.0, 0.0, 2e-3}, {0.016, 0.016, 0.004}, 0.05, d);
    };
    cases.push_back(std::move(made));
}

} // namespace

void add_contact_cases(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Dice dice(variant);
    Affine const near{}, turned{dice.rotation(), dice.direction()},
        far{dice.rotation(), (variant ? dice.log_between(10.0, 1e3) : 1e3) * dice.direction()};
    for (int kind : {0, 1, 2}) {
        add_blocks(cases, variant ? turned : near, kind, variant ? ", turned" : "");
        add_blocks(cases, far, kind, ", far away");
    }
    dvec3 const metre = variant ? dice.direction() : dvec3(1.0, 0.0, 0.0);
    for (bool exact : {true, false}) {
        add_prisms(cases, variant, 1e-6, exact, metre);
        add_prisms(cases, variant, 0.0, exact, metre);
        add_doublet(cases, variant, exact);
        add_tumbler(cases, variant, exact, false);
        add_tumbler(cases, variant, exact, true);
        add_nested(cases, variant, exact);
        add_matched(cases, variant, exact);
        add_lens_on_plate(cases, variant, exact);
    }
    for (bool exact : {true, false}) {
        add_stack(cases, variant, exact);
        add_askew(cases, variant, exact);
    }
    add_ball_in_lens(cases, variant);
    add_ball_on_plate(cases, variant);
}

} // namespace sahl::bench

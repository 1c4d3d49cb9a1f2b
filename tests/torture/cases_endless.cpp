// Paths of ten thousand events, and corners that send light back from within rounding of an edge.
#include "torture/aim.h"
#include "torture/cases.h"

#include <numbers>

namespace sahl::bench {

namespace {

constexpr std::uint32_t endless = 10'000;

Affine place_of(Dice& dice, std::uint64_t variant) {
    return variant ? Affine{dice.rotation(), dice.in_box(dvec3(-1.0), dvec3(1.0))} : Affine{};
}

/// A long pipe along z; the light runs round in it, and back from its ends.
void add_pipe(std::vector<TortureCase>& cases, std::uint64_t variant, std::string name, std::string const& of,
              std::variant<Shape, MeshRef> body, double half_width) {
    Dice dice(1400 + variant);
    TortureCase made{std::move(name), of, {1.0, 1.5}, {{std::move(body), 1, place_of(dice, variant)}}, {}};
    Affine const place = made.parts[0].place;
    made.rule = Rule::reflect;
    made.events = endless;
    made.share = 2.0 / endless;
    made.ray = [=](Dice& d, std::uint64_t k) {
        dvec3 const p(0.4 * half_width * d.between(-1, 1), 0.4 * half_width * d.between(-1, 1),
                      0.4 * d.between(-1, 1));
        double const slant = d.log_between(1e-3, 1.0);
        dvec3 direction(slant * d.between(-1, 1), slant * d.between(-1, 1), d.sign());
        if (k % 5 == 0)
            direction.x = 0.0; // stays in one plane
        return through(place, p, direction, 0.0);
    };
    cases.push_back(std::move(made));
}

void add_gallery(std::vector<TortureCase>& cases, std::uint64_t variant, std::string name,
                 std::string const& of, std::variant<Shape, MeshRef> body, double least) {
    Dice dice(1500 + variant);
    TortureCase made{std::move(name), of, {1.0, 1.5}, {{std::move(body), 1, place_of(dice, variant)}}, {}};
    Affine const place = made.parts[0].place;
    made.rule = Rule::reflect;
    made.events = endless;
    made.share = 2.0 / endless;
    made.ray = [=](Dice& d, std::uint64_t) {
        double const grazing = d.log_between(least, 0.1), a = 2.0 * std::numbers::pi * d.uniform();
        double const height = 1e-2 * grazing * d.between(-1, 1), depth = std::cos(grazing);
        return through(place, {depth * std::cos(a), depth * std::sin(a), height},
                       {-std::sin(a), std::cos(a), 0.1 * grazing * d.between(-1, 1)}, 0.0);
    };
    cases.push_back(std::move(made));
}

/// From inside into a corner of right angles, close to its edges; back after three reflections.
void add_corner(std::vector<TortureCase>& cases, std::uint64_t variant, bool exact) {
    Dice dice(1600 + variant);
    Affine const place = place_of(dice, variant);
    TortureCase made{"a corner cube, to 1e-8 of its edges", exact ? "exact" : "mesh", {1.0, 1.5}, {}, {}};
    if (exact)
        made.parts = {{Box{dvec3(2.0)}, 1, compose(place, Affine{dmat3(1.0), dvec3(1.0)})}};
    else
        made.parts = {{mesh_of(corner_soup(1.0)), 1, place}};
    made.events = 6;
    made.rule = Rule::transmit;
    made.ray = [=](Dice& d, std::uint64_t k) {
        dvec3 p(0.2 * d.uniform(), 0.2 * d.uniform(), 0.2 * d.uniform());
        p[static_cast<int>(k % 3)] = 0.0; // on a face,
        if (k % 2)                        // next to an edge, or to the corner
            p[static_cast<int>((k + 1) % 3)] = d.log_between(1e-8, 1e-4);
        if (k % 4 == 3)
            p[static_cast<int>((k + 2) % 3)] = d.log_between(1e-8, 1e-4);
        dvec3 const direction =
            -normalize(dvec3(1.0) + 0.3 * dvec3(d.between(-1, 1), d.between(-1, 1), d.between(-1, 1)));
        return through(place, p, direction, k % 5 ? 0.02 : 2.0);
    };
    cases.push_back(std::move(made));
}

} // namespace

void add_endless_cases(std::vector<TortureCase>& cases, std::uint64_t variant) {
    Dice dice(variant + 7);
    double const half = variant ? dice.log_between(3e-3, 3e-2) : 1e-2;
    auto const around = static_cast<std::uint32_t>(variant ? 3 + dice.below(60) : 32);
    add_pipe(cases, variant, "a square light pipe", "exact", Box{{2.0 * half, 2.0 * half, 1.0}}, half);
    add_pipe(cases, variant, "a square light pipe", "mesh",
             mesh_of(box_soup({-half, -half, -0.5}, {half, half, 0.5}, variant % 2)), half);
    add_pipe(cases, variant, "a round light pipe", "exact", Cylinder{half, 1.0}, half);
    add_pipe(cases, variant, "a round light pipe", "mesh",
             mesh_of(revolved({{0.0, -0.5}, {half, -0.5}, {half, 0.5}, {0.0, 0.5}}, around)), half);
    add_gallery(cases, variant, "a whispering gallery in a ball", "exact", Sphere{1.0}, 1e-5);
    add_gallery(cases, variant, "a whispering gallery in a disk", "exact", Cylinder{1.0, 0.1}, 1e-5);
    auto const fine = static_cast<std::uint32_t>(variant ? 100 + dice.below(400) : 256);
    add_gallery(cases, variant, "a whispering gallery in a disk", "mesh",
                mesh_of(revolved({{0.0, -0.05}, {1.0, -0.05}, {1.0, 0.05}, {0.0, 0.05}}, fine)), 0.05);
    for (bool exact : {true, false})
        add_corner(cases, variant, exact);
}

} // namespace sahl::bench

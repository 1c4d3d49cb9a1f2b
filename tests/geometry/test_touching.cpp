// Straight lines through bodies that touch, meshes and exact shapes, in any frame: every line must cross what
// closed form says, in its order, faces that lie on each other as one.
#include "geometry/bvh.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/lathe.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace sahl;
using namespace sahl::bench;

namespace {

using Geometry = std::variant<Shape, std::shared_ptr<Mesh const>>;

Geometry mesh_of(TriangleSoup soup) {
    return std::make_shared<Mesh const>(make_mesh(std::move(soup)));
}

/// As glTF carries numbers, or as they are.
enum class Digits { doubles, floats };

double as_float(double x) {
    float volatile const rounded = static_cast<float>(x); // GCC 12 vectorises the two conversions away
    return rounded;
}

/// The same body with its coordinates in another frame, as another file would have them.
Geometry mesh_in(Affine const& frame, TriangleSoup soup, Digits digits = Digits::doubles) {
    for (dvec3& p : soup.positions) {
        p = inverse(frame).point(p);
        for (int axis = 0; digits == Digits::floats && axis < 3; ++axis)
            p[axis] = as_float(p[axis]);
    }
    return mesh_of(std::move(soup));
}

struct Part {
    Geometry geometry;
    Affine place{};
};

Affine at(double x, double y, double z) {
    return {dmat3(1.0), {x, y, z}};
}

Bvh assembled(std::vector<Part> const& parts, Affine const& frame) {
    std::vector<PlacedGeometry> geometries;
    std::uint32_t number = 0;
    for (Part const& part : parts) {
        geometries.push_back(
            {part.geometry, compose(frame, part.place), {10 * number}, {number}, false, false});
        ++number;
    }
    return Bvh(std::move(geometries));
}

/// What a line crosses: "+0 -0+1 -1" enters 0, goes over into 1, leaves it. '=' is an open surface.
std::string crossed(Bvh const& bvh, dvec3 const& origin, dvec3 const& direction) {
    Bvh::Start const start = bvh.start_at(origin, direction);
    ShellSet inside = start.inside;
    LeftSheets left = start.on;
    std::string story;
    dvec3 from = origin;
    for (int step = 0; step < 50; ++step) {
        NextHit const hit = bvh.next(from, direction, inside, left);
        if (hit.proof == Proof::leak)
            return story + " leak";
        if (hit.at_one_place.empty())
            return story;
        story += story.empty() ? "" : " ";
        for (bool enters : {false, true})
            for (Crossing const& c : hit.at_one_place) {
                if (c.enters != enters && !c.open)
                    continue;
                if (c.open && enters) {
                    story += "=" + std::to_string(c.object);
                    left.push_back({c.object, !c.enters});
                } else if (!c.open) {
                    story += (enters ? "+" : "-") + std::to_string(c.object);
                    if (enters)
                        inside.insert(c.shell);
                    else
                        inside.erase(c.shell);
                }
            }
        from = hit.at_one_place.front().point;
        left = bvh.still_there(left, from);
    }
    return story + " endless";
}

struct Line {
    dvec3 origin, direction;
};

/// Lines that go down through a disk of the plane z = 0, at up to `slant` from the axis; some through its
/// `marked` points, where edges and corners are.
Line line_through_disk(Dice& dice, double radius, double slant, std::vector<dvec3> const& marked) {
    dvec3 target(2.0);
    while (target.x * target.x + target.y * target.y > radius * radius)
        target = {dice.between(-radius, radius), dice.between(-radius, radius), 0.0};
    if (!marked.empty() && dice.below(2))
        target = marked[dice.below(marked.size())];
    double const angle = dice.below(4) ? slant * dice.uniform() : 0.0, turn = dice.between(0.0, 7.0);
    dvec3 const direction(std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn),
                          -std::cos(angle));
    return {target - 1.0 * direction, direction};
}

struct Case {
    std::string name;
    std::vector<Part> parts;
    std::string expected;
    double radius, slant;
    std::vector<dvec3> marked{};
};

/// Points of a mesh near z = 0 and the axis.
std::vector<dvec3> corners_near(TriangleSoup const& soup, double height, double radius) {
    std::vector<dvec3> points;
    for (dvec3 const& p : soup.positions)
        if (std::abs(p.z) <= height && p.x * p.x + p.y * p.y < radius * radius)
            points.push_back(p);
    return points;
}

int wrong_lines(Case const& c, Affine const& frame, int lines, std::uint64_t seed) {
    Dice dice(seed);
    Bvh const bvh = assembled(c.parts, frame);
    int wrong = 0;
    for (int k = 0; k < lines; ++k) {
        Line const line = line_through_disk(dice, c.radius, c.slant, c.marked);
        std::string const story =
            crossed(bvh, frame.point(line.origin), normalize(frame.vector(line.direction)));
        wrong += story != c.expected;
        if (story != c.expected && wrong == 1)
            UNSCOPED_INFO("crossed " << story << ", expected " << c.expected);
    }
    return wrong;
}

/// A cemented doublet with its common face's vertex at the origin, seen from above (light along −z).
std::vector<Part> doublet(Affine const& second_frame, std::uint32_t rings, std::uint32_t sectors,
                          Digits digits) {
    TriangleSoup const crown = lens_soup(-0.04, 0.05, 0.005, 0.02, rings, sectors),
                       flint = lens_soup(0.05, 0.2, 0.004, 0.02, rings, sectors);
    TriangleSoup lowered = crown;
    for (dvec3& p : lowered.positions)
        p.z -= 0.005;
    return {{mesh_in({}, lowered, digits)}, {mesh_in(second_frame, flint, digits), second_frame}};
}

std::vector<Case> cases(Dice& dice, Digits digits) {
    double const root = std::sqrt(0.5);
    // a prism's hypotenuse at 45°, the apex along y
    Affine const tilt{dmat3({1, 0, 0}, {0, root, root}, {0, -root, root}), dvec3(0.0)};
    Affine const other_frame{dice.rotation(), 0.03 * dice.direction()};
    TriangleSoup const common_face = lens_soup(0.05, 0.2, 0.004, 0.02, 12, 40);
    TriangleSoup const low_block = box_soup({-0.15, -0.15, -0.1}, {0.15, 0.15, 0.0}),
                       high_block = box_soup({-0.1, -0.1, 0.0}, {0.1, 0.1, 0.2}, true);
    double const glass_r = 0.04, bore_r = 0.03;
    TriangleSoup const
        glass = lathe_soup(
            {{0.0, -0.05}, {glass_r, -0.05}, {glass_r, 0.05}, {bore_r, 0.05}, {bore_r, -0.04}, {0.0, -0.04}},
            40),
        liquid = lathe_soup({{0.0, -0.04}, {bore_r, -0.04}, {bore_r, 0.02}, {0.0, 0.02}}, 40);
    std::vector<dvec3> diagonal;
    for (int k = -9; k <= 9; ++k)
        for (double side : {-1.0, 1.0})
            diagonal.push_back({0.009 * k, side * 0.009 * k, 0.0});
    return {
        {"blocks, other diagonals",
         {{mesh_in({}, low_block, digits)}, {mesh_in({}, high_block, digits)}},
         "+1 -1+0 -0",
         0.09,
         0.1,
         diagonal},
        {"blocks of two files",
         {{mesh_in({}, low_block, digits)}, {mesh_in(other_frame, high_block, digits), other_frame}},
         "+1 -1+0 -0",
         0.09,
         0.1,
         diagonal},
        {"a mesh on an exact box",
         {{Box{{0.3, 0.3, 0.1}}, at(0.0, 0.0, -0.05)},
          {mesh_in(other_frame, high_block, digits), other_frame}},
         "+1 -1+0 -0",
         0.09,
         0.1,
         diagonal},
        {"a block between two, turned by 45°",
         {{mesh_in(inverse(tilt), box_soup(dvec3(-0.1, -0.1, -0.1), dvec3(0.1, 0.1, 0.0)), digits)},
          {mesh_in(inverse(tilt), box_soup(dvec3(-0.2, -0.2, 0.0), dvec3(0.2, 0.2, 0.05), true), digits)},
          {Box{{0.3, 0.3, 0.1}}, compose(tilt, at(0.0, 0.0, 0.1))}},
         "+2 -2+1 -1+0 -0",
         0.02,
         0.05},
        {"a doublet of two meshes", doublet({}, 12, 40, digits), "+1 -1+0 -0", 0.016, 0.1,
         corners_near(common_face, 0.004, 0.016)},
        {"a doublet of two files", doublet(other_frame, 12, 40, digits), "+1 -1+0 -0", 0.016, 0.1,
         corners_near(common_face, 0.004, 0.016)},
        {"liquid in a glass",
         {{mesh_in({}, glass, digits)}, {mesh_in(other_frame, liquid, digits), other_frame}},
         "+1 -1+0 -0",
         0.02,
         0.1},
        {"a mirror cemented to a lens's flat face",
         {{mesh_in(other_frame, lens_soup(0.0, 0.05, 0.004, 0.02, 12, 40), digits), other_frame},
          {Disk{0.019}}},
         "+0 -0=1",
         0.015,
         0.1,
         corners_near(common_face, 0.004, 0.015)},
        {"a detector glued to a rod",
         {{mesh_in(other_frame, lathe_soup({{0.0, 0.0}, {0.02, 0.0}, {0.02, 0.1}, {0.0, 0.1}}, 40), digits),
           other_frame},
          {Rectangle{{0.1, 0.1}}}},
         "+0 -0=1",
         0.015,
         0.1},
    };
}

} // namespace

TEST_CASE("lines through bodies that touch cross what closed form says, in any frame") {
    for (Digits digits : {Digits::doubles, Digits::floats}) {
        Dice dice(1);
        for (int k = 0; k < 4; ++k)
            for (Case const& c : cases(dice, digits)) {
                Affine const frame =
                    k == 0 ? Affine{} : Affine{dice.rotation(), (k == 3 ? 1e3 : 0.3) * dice.direction()};
                CAPTURE(c.name, k, digits == Digits::floats);
                CHECK(wrong_lines(c, frame, 1000, 2) == 0);
            }
    }
}

TEST_CASE("and a million of them", "[slow]") {
    for (Digits digits : {Digits::doubles, Digits::floats}) {
        Dice dice(3);
        for (Case const& c : cases(dice, digits)) {
            CAPTURE(c.name, digits == Digits::floats);
            CHECK(wrong_lines(c, {dice.rotation(), dice.direction()}, 100'000, 4) == 0);
        }
    }
}

TEST_CASE("a gap stays a gap, a micrometre a metre away, whatever lies on either side") {
    Dice dice(5);
    TriangleSoup const low_block = box_soup({-0.15, -0.15, -0.1}, {0.15, 0.15, 0.0}),
                       high_block = box_soup({-0.1, -0.1, 0.0}, {0.1, 0.1, 0.2}, true);
    Affine const other_frame{dice.rotation(), 0.03 * dice.direction()};
    Part const exact{Box{{0.3, 0.3, 0.1}}, at(0.0, 0.0, -0.05)};
    for (double gap : {1e-6, 1e-9, 1e-12})
        for (Part const& low : {Part{mesh_of(low_block)}, exact}) {
            Part const high{mesh_in(other_frame, high_block), compose(at(0.0, 0.0, gap), other_frame)};
            Case const c{"", {low, high}, "+1 -1 +0 -0", 0.09, 0.1};
            CAPTURE(gap, low.geometry.index());
            CHECK(wrong_lines(c, {}, 200, 6) == 0);
            for (int k = 0; k < 5; ++k)
                CHECK(wrong_lines(c, {dice.rotation(), dice.direction()}, 200, 7) == 0);
        }
}

/// A block whose top is a saddle of 8 × 8 quads, which lie on no plane, or that lies on top of one.
TriangleSoup saddle_block(bool on_top, bool other_diagonals) {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    constexpr std::uint32_t n = 8;
    auto const put = [&](double z, double saddle) {
        for (std::uint32_t i = 0; i <= n; ++i)
            for (std::uint32_t j = 0; j <= n; ++j) {
                double const x = (2.0 * i / n - 1.0) * 0.1, y = (2.0 * j / n - 1.0) * 0.1;
                soup.positions.push_back({x, y, z + saddle * x * y});
            }
    };
    put(on_top ? 0.0 : -0.1, on_top ? 2.0 : 0.0);
    put(on_top ? 0.1 : 0.0, on_top ? 0.0 : 2.0);
    auto const quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, bool turn) {
        add_triangle(soup, a, b, turn ? d : c);
        add_triangle(soup, turn ? b : a, c, d);
    };
    constexpr std::uint32_t layer = (n + 1) * (n + 1);
    auto const at_grid = [](std::uint32_t i, std::uint32_t j) { return i * (n + 1) + j; };
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j)
            for (std::uint32_t first : {0u, layer}) {
                std::uint32_t const a = first + at_grid(i, j), b = first + at_grid(i + 1, j),
                                    c = first + at_grid(i + 1, j + 1), d = first + at_grid(i, j + 1);
                first ? quad(a, b, c, d, other_diagonals) : quad(d, c, b, a, other_diagonals);
            }
    for (std::uint32_t k = 0; k < n; ++k)
        for (auto const& [from, to] :
             {std::pair(at_grid(k, 0), at_grid(k + 1, 0)), std::pair(at_grid(k + 1, n), at_grid(k, n)),
              std::pair(at_grid(0, k + 1), at_grid(0, k)), std::pair(at_grid(n, k), at_grid(n, k + 1))})
            quad(from, to, to + layer, from + layer, false);
    return soup;
}

TEST_CASE("quads that lie on no plane and are cut along different diagonals are one boundary") {
    Dice dice(13);
    Affine const other_file{dice.rotation(), 0.1 * dice.direction()};
    for (Digits digits : {Digits::doubles, Digits::floats})
        for (bool other_diagonals : {false, true}) {
            TriangleSoup const low = saddle_block(false, false), high = saddle_block(true, other_diagonals);
            Case const c{
                "",           {{mesh_in({}, low, digits)}, {mesh_in(other_file, high, digits), other_file}},
                "+1 -1+0 -0", 0.09,
                0.1,          corners_near(low, 0.05, 0.09)};
            CAPTURE(digits == Digits::floats, other_diagonals);
            CHECK(wrong_lines(c, {}, 1000, 14) == 0);
            CHECK(wrong_lines(c, {dice.rotation(), dice.direction()}, 1000, 15) == 0);
        }
}

TEST_CASE("shells of one mesh that touch are one boundary") {
    Dice dice(12);
    for (Digits digits : {Digits::doubles, Digits::floats})
        for (int k = 0; k < 5; ++k) {
            // blocks of other sizes, so that they share no edge
            TriangleSoup soup = together(box_soup({-0.15, -0.15, -0.1}, {0.15, 0.15, 0.0}),
                                         box_soup({-0.1, -0.1, 0.0}, {0.1, 0.1, 0.2}, true));
            Affine const file{dice.rotation(), 0.1 * dice.direction()};
            std::vector<PlacedGeometry> geometries;
            geometries.push_back({std::get<1>(mesh_in(file, soup, digits)), file, {0}, {0}, false, false});
            Bvh const bvh(std::move(geometries));
            int wrong = 0;
            for (int line = 0; line < 200; ++line) {
                auto const [origin, direction] = line_through_disk(dice, 0.09, 0.1, {});
                NextHit const first = bvh.next(origin, direction, {}, {});
                REQUIRE(first.at_one_place.size() == 1);
                ShellSet inside;
                inside.insert(first.at_one_place.front().shell);
                NextHit const second = bvh.next(first.at_one_place.front().point, direction, inside, {});
                wrong += second.at_one_place.size() != 2;
            }
            CAPTURE(digits == Digits::floats, k);
            CHECK(wrong == 0);
        }
}

TEST_CASE("the rounding of float data is no gap, and a micrometre is, a metre from the origin") {
    double const root = std::sqrt(0.5);
    Affine const tilt{dmat3({1, 0, 0}, {0, root, root}, {0, -root, root}), dvec3(0.0)};
    Dice dice(9);
    for (dvec3 const& baked : {dvec3(0.0), dvec3(0.7, 0.5, -0.6)})
        for (double gap : {0.0, 1e-6})
            for (bool exact : {false, true}) {
                // both prisms' common face at 45°, their numbers as files have them: in floats, far from zero
                Affine const low_file = compose(inverse(tilt), at(-baked.x, -baked.y, -baked.z));
                TriangleSoup raised = box_soup({-0.1, -0.1, gap}, {0.1, 0.1, 0.2}, true);
                Part const low =
                    exact ? Part{Box{{0.3, 0.3, 0.1}}, at(0.0, 0.0, -0.05)}
                          : Part{mesh_in(low_file, box_soup({-0.15, -0.15, -0.1}, {0.15, 0.15, 0.0}),
                                         Digits::floats),
                                 low_file};
                Part const high{mesh_in(low_file, raised, Digits::floats), low_file};
                Case const c{"", {low, high}, gap == 0.0 ? "+1 -1+0 -0" : "+1 -1 +0 -0", 0.09, 0.1};
                CAPTURE(length(baked), gap, exact);
                CHECK(wrong_lines(c, {}, 200, 10) == 0);
                CHECK(wrong_lines(c, {dice.rotation(), dice.direction()}, 200, 11) == 0);
            }
}

TEST_CASE(
    "faces that are nearly the same lie on each other, though their corners are a little apart along them") {
    // in float data the corners could be one another's, but for a little more than rounding
    for (double const longer : {1e-9, 1e-7, 3e-7, 1e-6, 1e-5, 1e-3}) {
        Bvh const bvh = assembled({{mesh_of(box_soup({0.125, 0.0, 0.0}, {0.375, 0.25, 0.375}))},
                                   {mesh_of(box_soup({0.125, 0.0, 0.375}, {0.375 + longer, 0.25, 0.5}))}},
                                  {});
        CAPTURE(longer);
        Dice dice(17);
        for (int k = 0; k < 50; ++k) {
            dvec3 const from(dice.between(0.13, 0.37), dice.between(0.01, 0.24), -1.0);
            CHECK(crossed(bvh, from, {0.0, 0.0, 1.0}) == "+0 -0+1 -1");
        }
    }
}

TEST_CASE("a lens that lies on a plate touches it at one point") {
    Dice dice(8);
    Part const plate{Box{{0.1, 0.1, 0.01}}, at(0.0, 0.0, -0.005)}, lens{Lens{0.05, -0.05, 0.004, 0.02}};
    for (int k = 0; k < 20; ++k) {
        Affine const frame = k ? Affine{dice.rotation(), dice.direction()} : Affine{};
        Bvh const bvh = assembled({plate, lens}, frame);
        REQUIRE(bvh.tangencies().size() == 1);
        CHECK(bvh.contacts().empty());
        CHECK(length(bvh.tangencies().front().at - frame.offset) < 1e-13);
        for (double tilt : {0.0, 0.1, 0.5}) {
            dvec3 const down(std::sin(tilt), 0.0, -std::cos(tilt));
            auto const story = [&](double aside) {
                return crossed(bvh, frame.point(dvec3(aside, 0.0, 0.0) - 0.002 * down), frame.vector(down));
            };
            CHECK(story(1e-6) == "-1 +0 -0"); // where the gap is 0.01 nm
            CHECK(story(1e-4) == "-1 +0 -0");
            // at the point itself either is right, but for a leak
            std::string const there = story(0.0);
            CAPTURE(there);
            CHECK((there == "-1 +0 -0" || there == "+0 -1 -0"));
        }
    }
    Part const lifted{Lens{0.05, -0.05, 0.004, 0.02}, at(0.0, 0.0, 1e-9)};
    CHECK(assembled({plate, lifted}, {}).tangencies().empty());
}

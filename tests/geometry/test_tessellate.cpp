// Tessellations of the exact shapes: their corners lie on them, they are closed, and what lies between the
// corners comes nearer by the square of the pieces' length. Judges: the shapes themselves as they are traced,
// their volume by the definition in words, closed forms.
#include "geometry/mesh.h"
#include "geometry/revolved.h"
#include "geometry/shape_oracle.h"
#include "geometry/solid.h"
#include "geometry/tessellate.h"
#include "support/catch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

using namespace sahl;
using namespace sahl::bench;

namespace {

struct Errors {
    double corner = 0.0, corner_normal = 0.0; // at the corners: m, sine
    double place = 0.0, normal = 0.0;         // within the triangles
};

double sine(dvec3 const& a, dvec3 const& b) {
    return length(cross(normalize(a), normalize(b))) + (dot(a, b) > 0.0 ? 0.0 : 2.0);
}

/// settle(face, place, normal) moves the place onto the shape and returns the normal there, or that which it
/// is given where there is none.
template <class Settle>
Errors errors_of(TriangleSoup const& soup, Settle settle) {
    Errors worst;
    auto const look = [&](std::uint32_t face, dvec3 const& place, dvec3 const& normal, double& far,
                          double& off) {
        dvec3 on = place;
        dvec3 const truth = settle(face, on, normal);
        far = std::max(far, length(on - place));
        off = std::max(off, sine(truth, normal));
    };
    constexpr std::array<dvec3, 4> inside{
        dvec3(1.0 / 3.0), {0.5, 0.5, 0.0}, {0.0, 0.5, 0.5}, {0.5, 0.0, 0.5}};
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        auto const [a, b, c] = soup.triangles[t];
        for (std::uint32_t const corner : {a, b, c})
            look(soup.triangle_face[t], soup.positions[corner], soup.normals[corner], worst.corner,
                 worst.corner_normal);
        for (dvec3 const& w : inside)
            look(soup.triangle_face[t],
                 w.x * soup.positions[a] + w.y * soup.positions[b] + w.z * soup.positions[c],
                 w.x * soup.normals[a] + w.y * soup.normals[b] + w.z * soup.normals[c], worst.place,
                 worst.normal);
    }
    return worst;
}

Errors errors_of(Shape const& shape, unsigned turn) {
    Solid const solid(shape);
    auto const* const quadric = std::get_if<QuadricBody>(&shape);
    auto const* const cone = std::get_if<Cone>(&shape);
    return errors_of(
        tessellate(shape, turn).soup, [&](std::uint32_t face, dvec3& place, dvec3 const& normal) {
            if (quadric && face == 1) { // which side of the box, the normal tells
                for (int axis = 0; axis < 3; ++axis)
                    if (normal[axis] != 0.0)
                        place[axis] = 0.5 * normal[axis] * quadric->clip[axis];
                return normal;
            }
            bool const tip = cone && face == 0 && std::hypot(place.x, place.y) < 0.1;
            dvec3 const truth = solid.settle(face, place);
            return tip ? normal : truth; // one at an apex there is none, and near it normals turn
        });
}

double signed_volume(TriangleSoup const& soup) {
    double sum = 0.0;
    for (auto const& [a, b, c] : soup.triangles)
        sum += dot(soup.positions[a], cross(soup.positions[b], soup.positions[c])) / 6.0;
    return sum;
}

/// As a file of floats carries it.
TriangleSoup in_floats(TriangleSoup soup) {
    for (dvec3& p : soup.positions)
        p = dvec3(glm::vec3(p));
    return soup;
}

/// By the definition in words, at the middles of 96³ cells.
double volume_in_words(Shape const& shape) {
    Solid const solid(shape);
    constexpr int n = 96;
    dvec3 const cell = (solid.high() - solid.low()) / static_cast<double>(n);
    int inside = 0;
    for (int i = 0; i < n * n * n; ++i) {
        dvec3 const at(i % n + 0.5, i / n % n + 0.5, i / (n * n) + 0.5);
        inside += depth(shape, solid.low() + cell * at) > 0.0;
    }
    return inside * cell.x * cell.y * cell.z;
}

} // namespace

TEST_CASE("a shape's tessellation is closed, faces outwards, and has its corners and normals on the shape",
          "[geometry]") {
    for (auto const& [name, shape] : closed_shapes()) {
        INFO(name);
        Tessellation const made = tessellate(shape, 96);
        REQUIRE(made.problem.empty());
        Errors const errors = errors_of(shape, 96);
        // sizes are about a metre, and a corner takes some ten roundings
        CHECK(errors.corner < 4e-15);
        CHECK(errors.corner_normal < 4e-15);
        Mesh const mesh = make_mesh(in_floats(made.soup));
        CHECK(mesh.closed());
        CHECK(mesh.flipped_triangles == 0);
        CHECK(mesh.shells.size() == 1);
        // what the turn's chords leave out, and the cells in words
        CHECK(signed_volume(made.soup) == Approx(volume_in_words(shape)).epsilon(0.02));
        std::vector<bool> seen(made.soup.face_names.size(), false);
        for (std::uint32_t const face : made.soup.triangle_face)
            seen[face] = true;
        bool const lacks_one = name == "hemisphere" || name == "ball with a rim of no width" || // the edge
                               name == "ellipsoid" ||                                           // the caps
                               name == "cone" || name == "cone on its tip";                     // an end
        CHECK(std::count(seen.begin(), seen.end(), false) == lacks_one);
    }
}

TEST_CASE("a tessellation comes nearer to its shape by the square of its fineness, places and normals",
          "[geometry]") {
    for (auto const& [name, shape] : closed_shapes()) {
        INFO(name);
        Errors const coarse = errors_of(shape, 48), fine = errors_of(shape, 192);
        // four times as fine: sixteen times as near; the worst place of an irregular grid wanders
        CHECK((coarse.place < 1e-15 || coarse.place / fine.place > 10.5));
        // a turn of 192 pieces: sagitta (π/192)²/2 of a radius below 1, in cells of a third as many along the
        // box six times that
        CHECK(fine.place < 6e-3);
        CHECK((coarse.normal < 4e-15 || coarse.normal / fine.normal > 8.0 || coarse.normal < 1e-9));
    }
}

TEST_CASE("a tessellation's volume comes nearer by the square of its fineness", "[geometry]") {
    double const pi = std::numbers::pi;
    std::pair<Shape, double> const known[] = {
        {Sphere{1.0}, 4.0 / 3.0 * pi},
        {Cylinder{0.5, 1.5}, 0.375 * pi},
        {Cone{0.6, 0.3, 0.8}, 0.8 / 3.0 * pi * (0.36 + 0.18 + 0.09)},
        {Cone{0.0, 0.6, 1.2}, 0.4 * pi * 0.36},
        {Lens{0.5, 0.0, 0.5, 1.0}, 2.0 / 3.0 * pi * 0.125},
        // a paraboloid z = r²/2 up to r = ½, under the plane z = 0.4
        {Lens{1.0, 0.0, 0.4, 1.0, -1.0}, pi * (0.4 * 0.25 - 0.0625 / 4.0)},
        {QuadricBody{{1.0, 4.0, 1.0, 0, 0, 0, 0, 0, 0, -0.25}, dvec3(1.2)}, 4.0 / 3.0 * pi * 0.125 * 0.5},
        {QuadricBody{{1.0, 1.0, -1.0, 0, 0, 0, 0, 0, 0, 0}, dvec3(2.0)}, 2.0 / 3.0 * pi}, // a double cone
    };
    for (auto const& [shape, volume] : known) {
        INFO(volume);
        double const coarse = volume - signed_volume(tessellate(shape, 48).soup),
                     fine = volume - signed_volume(tessellate(shape, 192).soup);
        CHECK(coarse / fine == Approx(16.0).epsilon(0.25));
    }
}

TEST_CASE("open shapes are tessellated towards +z, and a conic mirror of second order with its hole",
          "[geometry]") {
    for (ConicMirror const& mirror :
         {ConicMirror{1.0, -1.0, 1.2}, ConicMirror{-0.7, 0.0, 1.2, 0.3}, ConicMirror{0.0, 0.0, 1.0, 0.2}}) {
        RevolvedSheet const sheet(form_of(mirror), 0.5 * mirror.diameter, 0.5 * mirror.hole_diameter);
        auto const settle = [&](std::uint32_t, dvec3& place, dvec3 const&) { return sheet.settle(place); };
        TriangleSoup const soup = tessellate(mirror, 192).soup;
        Errors const coarse = errors_of(tessellate(mirror, 48).soup, settle), fine = errors_of(soup, settle);
        CHECK(fine.corner < 4e-15);
        CHECK(fine.corner_normal < 4e-15);
        CHECK((mirror.radius == 0.0 || coarse.place / fine.place > 14.0));
        double area = 0.0; // seen along the axis
        for (auto const& [a, b, c] : soup.triangles) {
            dvec3 const twice =
                cross(soup.positions[b] - soup.positions[a], soup.positions[c] - soup.positions[a]);
            CHECK(twice.z > 0.0);
            area += 0.5 * twice.z;
        }
        double const h = 0.5 * mirror.diameter, hole = 0.5 * mirror.hole_diameter;
        CHECK(area == Approx(std::numbers::pi * (h * h - hole * hole)).epsilon(1e-3));
    }
    TriangleSoup const ring = tessellate(Disk{1.0, 0.5}, 600).soup;
    double area = 0.0;
    for (auto const& [a, b, c] : ring.triangles)
        area += 0.5 * cross(ring.positions[b] - ring.positions[a], ring.positions[c] - ring.positions[a]).z;
    CHECK(area == Approx(0.75 * std::numbers::pi).epsilon(1e-4));
    CHECK(tessellate(Rectangle{{1.0, 2.0}}, 6).soup.triangles.size() == 2);
}

TEST_CASE("degenerate quadrics are tessellated where they enclose something", "[geometry]") {
    auto const volume = [](std::array<double, 10> const& k) {
        Tessellation const made = tessellate(QuadricBody{k, dvec3(2.0)}, 96);
        INFO(made.problem);
        REQUIRE(made.problem.empty());
        // seen edge by edge: each is run through as often one way as the other
        std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> ways;
        for (auto const& t : made.soup.triangles)
            for (std::size_t i = 0; i < 3; ++i) {
                auto const key = [&](std::uint32_t v) {
                    glm::vec3 const p(made.soup.positions[v]);
                    return std::array<float, 3>{p.x + 0.0F, p.y + 0.0F, p.z + 0.0F};
                };
                ++ways[{key(t[i]), key(t[(i + 1) % 3])}];
                --ways[{key(t[(i + 1) % 3]), key(t[i])}];
            }
        CHECK(std::all_of(ways.begin(), ways.end(), [](auto const& way) { return way.second == 0; }));
        return signed_volume(made.soup);
    };
    double const pi = std::numbers::pi;
    CHECK(volume({1, 1, 0, 0, 0, 0, 0, 0, 0, -0.25}) == Approx(0.5 * pi).epsilon(0.01));    // a cylinder
    CHECK(volume({0, 0, 1, 0, 0, 0, 0, 0, 0, -0.25}) == Approx(4.0));                       // two planes
    CHECK(volume({-1, 0, 1, 0, 0, 0, 0, 0, 0, 0}) == Approx(4.0));                          // that cross
    CHECK(volume({0, 0, 0, 0, 0, 0, 0.3, 0.5, 1, 0}) == Approx(4.0));                       // one plane
    CHECK(volume({1, 1, -1, 0, 0, 0, 0, 0, 0, 0}) == Approx(2.0 / 3.0 * pi).epsilon(0.01)); // a cone
    CHECK(volume({-1, -1, -1, 0, 0, 0, 0, 0, 0, 0}) == Approx(8.0));                        // everywhere
    CHECK(volume({1, 0, 0, 0, 0, 0, 0, 0, -1, 0}) == Approx(8.0 / 2.0 - 4.0 / 3.0).epsilon(0.01)); // a gutter
}

TEST_CASE("what cannot be tessellated says why", "[geometry]") {
    CHECK(tessellate(Plane{}, 96).problem.find("no end") != std::string::npos);
    for (std::array<double, 10> const& nothing : {std::array<double, 10>{1, 1, 1, 0, 0, 0, 0, 0, 0, 1},
                                                  {0, 0, 1, 0, 0, 0, 0, 0, 0, 0},       // a plane twice
                                                  {1, 1, 1, 0, 0, 0, 0, 0, 0, 0},       // a point
                                                  {0, 0, 0, 0, 0, 0, 0, 0, -1, 1.0}}) { // its box's face
        Tessellation const made = tessellate(QuadricBody{nothing, dvec3(2.0)}, 48);
        CHECK(made.problem.find("encloses nothing") != std::string::npos);
        CHECK(made.soup.triangles.empty());
    }
    // a plate of a hundredth across cells of an eighth
    QuadricBody const thin{{0.36, 0, 0.64, 0, 0.96, 0, 0, 0, 0, -2.5e-5}, dvec3(2.0)};
    CHECK(tessellate(thin, 48).problem.find("thinner than the cells") != std::string::npos);
    CHECK(tessellate(thin, 900).problem.find("at most 768") != std::string::npos);
}

// Polygons, convex and not, cut into triangles: as many as there must be, none turned over, together the
// area.
#include "geometry/polygon.h"
#include "support/catch.h"

#include <cmath>
#include <map>
#include <random>

using namespace sahl;

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

bool cut(std::vector<dvec3> const& corners, Triangles& triangles, std::uint64_t patience = 1000000000) {
    return cut_polygon(corners, triangles, patience);
}

double area_along(std::vector<dvec3> const& p, std::array<std::uint32_t, 3> const& t, dvec3 const& axis) {
    return 0.5 * dot(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]), axis);
}

/// Shoelace formula, along the unit vector `axis`.
double outline_area(std::vector<dvec3> const& p, dvec3 const& axis) {
    dvec3 sum(0.0);
    for (std::size_t i = 0; i < p.size(); ++i)
        sum += cross(p[i], p[(i + 1) % p.size()]);
    return 0.5 * dot(sum, axis);
}

/// Every edge of the outline once, every other edge once each way: what makes a closed mesh stay closed.
bool border_is_outline(Triangles const& triangles, std::uint32_t size) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (auto const& t : triangles)
        for (std::size_t i = 0; i < 3; ++i)
            ++edges[{t[i], t[(i + 1) % 3]}];
    for (std::uint32_t i = 0; i < size; ++i)
        --edges[{i, (i + 1) % size}];
    for (auto const& [edge, count] : edges) {
        auto const back = edges.find({edge.second, edge.first});
        if (count != (back == edges.end() ? 0 : back->second))
            return false;
    }
    return triangles.size() == size - 2;
}

/// No triangle turned over, and the sum of areas that of the outline: then none overlap.
void check_filled(std::vector<dvec3> const& corners, dvec3 const& axis = {0, 0, 1}) {
    Triangles triangles;
    CHECK(cut(corners, triangles));
    CHECK(border_is_outline(triangles, static_cast<std::uint32_t>(corners.size())));
    double sum = 0.0, least = 1.0;
    for (auto const& t : triangles) {
        double const area = area_along(corners, t, axis);
        sum += area;
        least = std::min(least, area);
    }
    double const whole = outline_area(corners, axis);
    CHECK(sum ==
          Approx(whole).epsilon(1e-14 + 0x1p-51 * static_cast<double>(corners.size()))); // rounding of a sum
    CHECK(least >= 0.0);
}

/// Corners at random distances round a centre: never crosses itself, and is seldom convex.
std::vector<dvec3> star(std::uint32_t size, double least) {
    std::mt19937_64 random(size);
    std::uniform_real_distribution<double> distance(least, 1.0);
    std::vector<dvec3> corners;
    for (std::uint32_t i = 0; i < size; ++i) {
        double const r = distance(random), angle = 6.283185307179586 * i / size;
        corners.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
    return corners;
}

} // namespace

TEST_CASE("a concave quadrilateral is cut along the diagonal that lies inside it") {
    for (std::size_t first = 0; first < 4; ++first) {
        std::vector<dvec3> const arrow{{0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}};
        std::vector<dvec3> corners;
        for (std::size_t i = 0; i < 4; ++i)
            corners.push_back(arrow[(first + i) % 4]);
        check_filled(corners);
    }
}

TEST_CASE("polygons are filled whichever way they face") {
    std::vector<dvec3> const flat = star(30, 0.2);
    check_filled(flat);
    std::vector<dvec3> turned, behind;
    for (dvec3 const& p : flat) {
        turned.push_back({3.0 + 0.1 * p.x, p.x, p.y}); // leans on the plane x = 3
        behind.insert(behind.begin(), p);
    }
    check_filled(turned, normalize(dvec3(1, -0.1, 0)));
    check_filled(behind, dvec3(0, 0, -1));
}

TEST_CASE("corners on a straight edge are kept, and spoil nothing") {
    std::vector<dvec3> square;
    for (int side = 0; side < 4; ++side)
        for (int i = 0; i < 25; ++i) {
            double const t = i / 25.0;
            dvec3 const edge[] = {{t, 0, 0}, {1, t, 0}, {1 - t, 1, 0}, {0, 1 - t, 0}};
            square.push_back(edge[side]);
        }
    check_filled(square);
    check_filled({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
}

TEST_CASE("a hole joined to the outline by a bridge is left open") {
    // a square of side 4 with a hole of side 2, entered and left along one line
    check_filled({{0, 0, 0},
                  {4, 0, 0},
                  {4, 4, 0},
                  {0, 4, 0},
                  {0, 0, 0},
                  {1, 1, 0},
                  {1, 3, 0},
                  {3, 3, 0},
                  {3, 1, 0},
                  {1, 1, 0}});
}

TEST_CASE("an outline that crosses itself is told, and its border kept") {
    std::vector<dvec3> bow; // seventeen corners and more: an eight of two loops, one of them larger
    for (int i = 0; i < 40; ++i) {
        double const t = 6.283185307179586 * i / 40;
        bow.emplace_back(std::sin(2.0 * t) * (std::cos(t) > 0 ? 1.0 : 2.0),
                         std::cos(t) * (std::cos(t) > 0 ? 1.0 : 2.0), 0.0);
    }
    Triangles triangles;
    CHECK_FALSE(cut(bow, triangles));
    CHECK(border_is_outline(triangles, 40));
}

TEST_CASE("a polygon without area still gives as many triangles as it must") {
    Triangles triangles;
    CHECK(cut(std::vector<dvec3>(7, dvec3(1.0)), triangles));
    CHECK(border_is_outline(triangles, 7));
}

TEST_CASE("polygons of 200 000 corners are cut, convex, star, comb and spiral") {
    std::uint32_t const many = 200000;
    check_filled(star(many, 1.0));
    check_filled(star(many, 0.5));
    std::vector<dvec3> comb, spiral;
    for (std::uint32_t i = 0; i < many - 2; ++i)
        comb.emplace_back(double(i), i % 2 ? 1.0 + i % 7 : 1e5, 0.0);
    comb.emplace_back(double(many), -1.0, 0.0);
    comb.emplace_back(-1.0, -1.0, 0.0);
    std::vector<dvec3> const clockwise(comb.rbegin(), comb.rend());
    check_filled(clockwise);
    for (std::uint32_t i = 0; i < many; ++i) { // outwards, and back beside itself
        bool const out = i < many / 2;
        double const angle = (out ? i : many - 1 - i) * 0.01, r = 1.0 + angle + (out ? 2.0 : 0.0);
        spiral.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
    check_filled(spiral);
}

TEST_CASE("a polygon that would take too long is given up, and its border kept") {
    Triangles triangles;
    std::vector<dvec3> const corners = star(1000, 0.1);
    CHECK_FALSE(cut(corners, triangles, 100));
    CHECK(border_is_outline(triangles, 1000));
}

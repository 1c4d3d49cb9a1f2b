// In: a size and how fine. Out: closed meshes as files have them, and how often a mesh goes round a point,
// found by solid angles: slow, and with nothing in common with src/.
#pragma once

#include "geometry/mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace sahl::bench {

inline void add_triangle(TriangleSoup& soup, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    soup.triangles.push_back({a, b, c});
    soup.triangle_face.push_back(0);
}

/// Between two corners; each side is cut along one diagonal or the other.
inline TriangleSoup box_soup(dvec3 const& low, dvec3 const& high, bool other_diagonals = false) {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    for (int i = 0; i < 8; ++i)
        soup.positions.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    std::uint32_t const sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (auto const& s : sides)
        for (int half : {0, 2}) {
            int const k = other_diagonals ? half + 1 : half;
            add_triangle(soup, s[k % 4], s[(k + 1) % 4], s[(k + 2) % 4]);
        }
    return soup;
}

/// An icosahedron whose triangles are cut in four, and its vertices put on the sphere, `times` times.
inline TriangleSoup ball_soup(double radius, int times, dvec3 const& centre = dvec3(0.0)) {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    double const g = std::numbers::phi;
    for (double a : {-1.0, 1.0})
        for (double b : {-g, g}) {
            soup.positions.push_back({a, b, 0.0});
            soup.positions.push_back({0.0, a, b});
            soup.positions.push_back({b, 0.0, a});
        }
    for (dvec3& p : soup.positions)
        p = normalize(p);
    for (std::uint32_t a = 0; a < 12; ++a) // an icosahedron's faces: three vertices at the least distance
        for (std::uint32_t b = a + 1; b < 12; ++b)
            for (std::uint32_t c = b + 1; c < 12; ++c) {
                auto const near = [&](std::uint32_t i, std::uint32_t j) {
                    return length(soup.positions[i] - soup.positions[j]) < 1.1;
                };
                if (!near(a, b) || !near(b, c) || !near(c, a))
                    continue;
                dvec3 const &p = soup.positions[a], &q = soup.positions[b], &r = soup.positions[c];
                if (dot(cross(q - p, r - p), p) > 0.0)
                    add_triangle(soup, a, b, c);
                else
                    add_triangle(soup, a, c, b);
            }
    for (int k = 0; k < times; ++k) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        auto const middle = [&](std::uint32_t i, std::uint32_t j) {
            auto const [at, is_new] =
                middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(soup.positions.size()));
            if (is_new)
                soup.positions.push_back(normalize(soup.positions[i] + soup.positions[j]));
            return at->second;
        };
        auto const coarse = std::exchange(soup.triangles, {});
        soup.triangle_face.clear();
        for (auto const& [a, b, c] : coarse) {
            std::uint32_t const ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            add_triangle(soup, a, ab, ca);
            add_triangle(soup, b, bc, ab);
            add_triangle(soup, c, ca, bc);
            add_triangle(soup, ab, bc, ca);
        }
    }
    for (dvec3& p : soup.positions)
        p = centre + radius * p;
    return soup;
}

/// The sphere that an icosahedron makes whose sides are cut in `frequency` parts: 20 frequency² triangles.
inline TriangleSoup geodesic_soup(double radius, std::uint32_t frequency) {
    TriangleSoup const coarse = ball_soup(1.0, 0);
    TriangleSoup soup;
    soup.face_names = {"surface"};
    double const step = 1.0 / frequency;
    for (auto const& [a, b, c] : coarse.triangles) {
        auto const first = static_cast<std::uint32_t>(soup.positions.size());
        auto const at = [&](std::uint32_t row, std::uint32_t i) { return first + row * (row + 1) / 2 + i; };
        for (std::uint32_t row = 0; row <= frequency; ++row)
            for (std::uint32_t i = 0; i <= row;
                 ++i) { // shares of equal sides round alike, whichever way round
                dvec3 const p = (step * (frequency - row)) * coarse.positions[a];
                dvec3 const q = (step * (row - i)) * coarse.positions[b],
                            r = (step * i) * coarse.positions[c];
                soup.positions.push_back(radius * normalize(i == 0 ? p + q : row == i ? p + r : p + (q + r)));
            }
        for (std::uint32_t row = 0; row < frequency; ++row)
            for (std::uint32_t i = 0; i <= row; ++i) {
                add_triangle(soup, at(row, i), at(row + 1, i), at(row + 1, i + 1));
                if (i < row)
                    add_triangle(soup, at(row, i), at(row + 1, i + 1), at(row, i + 1));
            }
    }
    return soup;
}

inline TriangleSoup torus_soup(double ring, double tube, std::uint32_t around, std::uint32_t across) {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < across; ++j) {
            double const u = 2.0 * std::numbers::pi * i / around, v = 2.0 * std::numbers::pi * j / across;
            double const r = ring + tube * std::cos(v);
            soup.positions.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
            std::uint32_t const next_i = (i + 1) % around * across, next_j = (j + 1) % across;
            add_triangle(soup, i * across + j, next_i + j, next_i + next_j);
            add_triangle(soup, i * across + j, next_i + next_j, i * across + next_j);
        }
    return soup;
}

inline TriangleSoup together(TriangleSoup soup, TriangleSoup const& other) {
    auto const first = static_cast<std::uint32_t>(soup.positions.size());
    soup.positions.insert(soup.positions.end(), other.positions.begin(), other.positions.end());
    for (auto const& t : other.triangles)
        add_triangle(soup, first + t[0], first + t[1], first + t[2]);
    return soup;
}

inline TriangleSoup inside_out(TriangleSoup soup) {
    for (auto& t : soup.triangles)
        std::swap(t[1], t[2]);
    return soup;
}

/// How often one shell of the mesh goes round the point: ±1 inside, 0 outside. A triangle's solid angle: A.
/// van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125.
inline int turns_round(Mesh const& mesh, std::uint32_t shell, dvec3 const& point) {
    double angle = 0.0;
    for (std::size_t t = 0; t < mesh.soup.triangles.size(); ++t) {
        if (mesh.triangle_shell[t] != shell)
            continue;
        auto const& corners = mesh.soup.triangles[t];
        dvec3 const a = mesh.soup.positions[corners[0]] - point, b = mesh.soup.positions[corners[1]] - point,
                    c = mesh.soup.positions[corners[2]] - point;
        double const la = length(a), lb = length(b), lc = length(c);
        angle += 2.0 * std::atan2(dot(a, cross(b, c)),
                                  la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return static_cast<int>(std::lround(angle / (4.0 * std::numbers::pi)));
}

} // namespace sahl::bench

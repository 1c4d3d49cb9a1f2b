#include "report/drawn_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace sahl::report {

namespace {

constexpr double crease_cosine = 0.8660254037844387; // cos 30°, as in a mesh's health

/// Of each corner the number of the cell of a grid that it lies in; of `cells` cells along the longest side.
std::vector<std::uint32_t> cells_of(TriangleSoup const& soup, double cells) {
    dvec3 low(INFINITY), high(-INFINITY);
    for (dvec3 const& p : soup.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    dvec3 const size = high - low;
    double const step = std::max({size.x, size.y, size.z}) / cells;
    std::map<std::tuple<int, int, int>, std::uint32_t> known;
    std::vector<std::uint32_t> cell;
    cell.reserve(soup.positions.size());
    for (dvec3 const& p : soup.positions) {
        dvec3 const at = glm::floor((p - low) / step);
        cell.push_back(
            known
                .try_emplace({static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z)},
                             static_cast<std::uint32_t>(known.size()))
                .first->second);
    }
    return cell;
}

/// The soup with the corners of each cell in one place, the first of them; what has no area then is gone.
TriangleSoup clustered(TriangleSoup const& soup, std::vector<std::uint32_t> const& cell) {
    std::size_t const cells = cell.empty() ? 0 : 1 + *std::max_element(cell.begin(), cell.end());
    constexpr std::uint32_t none = ~0U;
    std::vector<std::uint32_t> first(cells, none);
    TriangleSoup out;
    out.face_names = soup.face_names;
    for (std::size_t i = 0; i < cell.size(); ++i)
        if (first[cell[i]] == none) {
            first[cell[i]] = static_cast<std::uint32_t>(out.positions.size());
            out.positions.push_back(soup.positions[i]);
            if (!soup.normals.empty())
                out.normals.push_back(soup.normals[i]);
        }
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        auto const [a, b, c] = soup.triangles[t];
        std::array<std::uint32_t, 3> const made{first[cell[a]], first[cell[b]], first[cell[c]]};
        if (made[0] == made[1] || made[1] == made[2] || made[2] == made[0])
            continue;
        out.triangles.push_back(made);
        if (!soup.triangle_face.empty())
            out.triangle_face.push_back(soup.triangle_face[t]);
    }
    return out;
}

TriangleSoup thinned(TriangleSoup const& soup, std::size_t most) {
    double cells = std::max(4.0, std::sqrt(static_cast<double>(most)));
    TriangleSoup out = clustered(soup, cells_of(soup, cells));
    for (int again = 0; again < 12 && out.triangles.size() > most; ++again) {
        cells *= std::min(
            0.9, 0.97 * std::sqrt(static_cast<double>(most) / static_cast<double>(out.triangles.size())));
        out = clustered(soup, cells_of(soup, cells));
    }
    return out;
}

/// One of each pair of ends that a triangle has between two places.
struct Side {
    std::uint32_t low, high; // places
    std::uint32_t from, to;  // corners
    std::uint32_t triangle;
};

/// Corners at exactly the same place have the same number.
std::vector<std::uint32_t> places_of(std::vector<dvec3> const& positions) {
    std::vector<std::uint32_t> order(positions.size()), place(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    auto const key = [&](std::uint32_t i) { // + 0.0: −0 is 0
        glm::vec3 const p(positions[i] + 0.0);
        return std::tuple(p.x + 0.0F, p.y + 0.0F, p.z + 0.0F);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        number += i > 0 && key(order[i]) != key(order[i - 1]) ? 1U : 0U;
        place[order[i]] = number;
    }
    return place;
}

std::vector<Side> sides_of(TriangleSoup const& soup) {
    std::vector<std::uint32_t> const place = places_of(soup.positions);
    std::vector<Side> sides;
    sides.reserve(3 * soup.triangles.size());
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t const from = soup.triangles[t][k], to = soup.triangles[t][(k + 1) % 3];
            auto const [low, high] = std::minmax(place[from], place[to]);
            if (low != high)
                sides.push_back({low, high, from, to, t});
        }
    std::sort(sides.begin(), sides.end(), [](Side const& a, Side const& b) {
        return std::tuple(a.low, a.high, a.triangle) < std::tuple(b.low, b.high, b.triangle);
    });
    return sides;
}

dvec3 normal_of(TriangleSoup const& soup, std::uint32_t triangle) {
    auto const& [a, b, c] = soup.triangles[triangle];
    dvec3 const n = cross(soup.positions[b] - soup.positions[a], soup.positions[c] - soup.positions[a]);
    double const size = length(n);
    return size > 0.0 ? n / size : dvec3(0.0);
}

void find_edges(TriangleSoup const& soup, DrawnMesh& drawn) {
    std::vector<Side> const sides = sides_of(soup);
    auto const face = [&](Side const& s) {
        return soup.triangle_face.empty() ? 0U : soup.triangle_face[s.triangle];
    };
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high)
            ++end;
        bool const sharp =
            end - i > 2 || (end - i == 2 && (face(sides[i]) != face(sides[i + 1]) ||
                                             dot(normal_of(soup, sides[i].triangle),
                                                 normal_of(soup, sides[i + 1].triangle)) < crease_cosine));
        if (end - i == 1)
            drawn.borders.insert(drawn.borders.end(), {sides[i].from, sides[i].to});
        else if (sharp)
            drawn.creases.insert(drawn.creases.end(), {sides[i].from, sides[i].to});
        i = end;
    }
}

} // namespace

DrawnMesh drawn_mesh(TriangleSoup const& given, std::size_t most) {
    DrawnMesh drawn;
    drawn.triangles_of_model = given.triangles.size();
    bool const fewer = given.triangles.size() > most;
    TriangleSoup const made = fewer ? thinned(given, most) : TriangleSoup();
    TriangleSoup const& soup = fewer ? made : given;
    for (dvec3 const& p : soup.positions)
        for (int axis = 0; axis < 3; ++axis)
            drawn.places.push_back(static_cast<float>(1e3 * p[axis]));
    for (dvec3 const& n : soup.normals)
        for (int axis = 0; axis < 3; ++axis)
            drawn.normals.push_back(
                static_cast<std::int16_t>(std::lround(32767.0 * std::clamp(n[axis], -1.0, 1.0))));
    for (std::uint32_t face = 0; face < soup.face_names.size(); ++face) {
        drawn.face_begins.push_back(static_cast<std::uint32_t>(drawn.triangles.size() / 3));
        for (std::size_t t = 0; t < soup.triangles.size(); ++t)
            if ((soup.triangle_face.empty() ? 0U : soup.triangle_face[t]) == face)
                drawn.triangles.insert(drawn.triangles.end(), soup.triangles[t].begin(),
                                       soup.triangles[t].end());
    }
    drawn.face_begins.push_back(static_cast<std::uint32_t>(drawn.triangles.size() / 3));
    find_edges(soup, drawn);
    return drawn;
}

} // namespace sahl::report

// In: a mesh, where it stands, and a view. Out: its silhouette as loops, and its creases.
#include "report/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace sahl::report {

namespace {

constexpr double crease = 0.8660254037844386; // cos 30°
constexpr std::size_t most_creases = 3000;

/// For each vertex the first one at the same place: a mesh keeps vertices apart whose normals differ.
std::vector<std::uint32_t> by_place(std::vector<dvec3> const& positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    auto const key = [&](std::uint32_t i) {
        return std::array{positions[i].x, positions[i].y, positions[i].z};
    };
    std::sort(order.begin(), order.end(),
              [&](auto a, auto b) { return key(a) < key(b) || (key(a) == key(b) && a < b); });
    std::vector<std::uint32_t> first(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
    return first;
}

struct HalfEdge {
    std::uint32_t low, high; // places, low < high
    std::uint32_t triangle;
    int along; // how the facet, turned to be counterclockwise in the view, runs: +1 low to high, −1, 0 seen
               // on edge
};

struct Directed {
    std::uint32_t from, to;
};

/// Strings directed edges together; where as many end at each place as begin there, every string is a loop.
std::vector<std::vector<std::uint32_t>> strings_of(std::vector<Directed> edges) {
    std::sort(edges.begin(), edges.end(), [](auto a, auto b) { return a.from < b.from; });
    std::vector<std::size_t> next(
        edges.size()); // of the edges that begin at one place: the next unused, at the first
    std::iota(next.begin(), next.end(), std::size_t{0});
    std::vector<bool> used(edges.size(), false);
    auto const unused_from = [&](std::uint32_t place) {
        auto const first = static_cast<std::size_t>(
            std::lower_bound(edges.begin(), edges.end(), place,
                             [](Directed e, std::uint32_t p) { return e.from < p; }) -
            edges.begin());
        if (first == edges.size())
            return first;
        while (next[first] < edges.size() && edges[next[first]].from == place && used[next[first]])
            ++next[first];
        return next[first] < edges.size() && edges[next[first]].from == place ? next[first] : edges.size();
    };
    std::vector<std::vector<std::uint32_t>> strings;
    for (std::size_t start = 0; start < edges.size(); ++start) {
        if (used[start])
            continue;
        std::vector<std::uint32_t> string{edges[start].from};
        for (std::size_t edge = start; edge < edges.size(); edge = unused_from(edges[edge].to)) {
            used[edge] = true;
            string.push_back(edges[edge].to);
        }
        strings.push_back(std::move(string));
    }
    return strings;
}

} // namespace

Outline outline_of(Mesh const& mesh, Affine const& to_world, View const& view) {
    auto const& positions = mesh.soup.positions;
    auto const place = by_place(positions);
    std::vector<dvec3> world(positions.size()), normals;
    std::transform(positions.begin(), positions.end(), world.begin(),
                   [&](dvec3 const& p) { return to_world.point(p); });

    std::vector<HalfEdge> half_edges;
    for (auto const& triangle : mesh.soup.triangles) {
        auto const corner = [&](std::size_t i) { return place[triangle[i % 3]]; };
        dvec3 const normal = cross(world[corner(1)] - world[corner(0)], world[corner(2)] - world[corner(0)]);
        double const facing = dot(normal, view.towards_viewer());
        int const turn = facing > 0.0 ? 1 : facing < 0.0 ? -1 : 0;
        for (std::size_t i = 0; i < 3; ++i) {
            std::uint32_t const a = corner(i), b = corner(i + 1);
            half_edges.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(normals.size()),
                                  a < b ? turn : -turn});
        }
        normals.push_back(length(normal) > 0.0 ? normalize(normal) : dvec3(0.0));
    }
    std::sort(half_edges.begin(), half_edges.end(), [](HalfEdge const& a, HalfEdge const& b) {
        return std::array{a.low, a.high, a.triangle} < std::array{b.low, b.high, b.triangle};
    });

    // All facets counterclockwise, their common edges cancel: what is left is the boundary of what they
    // cover. It winds about each point as often as facets cover it, so the nonzero rule fills just the mesh.
    std::vector<Directed> boundary;
    std::vector<std::pair<double, Polyline>> creases;
    for (std::size_t i = 0, end = 0; i < half_edges.size(); i = end) {
        HalfEdge const& e = half_edges[i];
        int sum = 0;
        for (end = i;
             end < half_edges.size() && half_edges[end].low == e.low && half_edges[end].high == e.high; ++end)
            sum += half_edges[end].along;
        for (int k = 0; k < std::abs(sum); ++k)
            boundary.push_back(sum > 0 ? Directed{e.low, e.high} : Directed{e.high, e.low});
        bool const smooth =
            end - i == 2 && dot(normals[e.triangle], normals[half_edges[i + 1].triangle]) >= crease;
        if (sum == 0 && !smooth) {
            dvec2 const a = view(world[e.low]), b = view(world[e.high]);
            creases.emplace_back(length(b - a), Polyline{a, b});
        }
    }
    Outline out;
    for (auto const& string : strings_of(std::move(boundary))) {
        Polyline loop;
        for (std::uint32_t const p : string)
            loop.push_back(view(world[p]));
        out.area.push_back(std::move(loop));
    }
    std::stable_sort(creases.begin(), creases.end(),
                     [](auto const& a, auto const& b) { return a.first > b.first; });
    creases.resize(std::min(creases.size(), most_creases));
    for (auto& [unused, line] : creases)
        out.lines.push_back(std::move(line));
    return out;
}

} // namespace sahl::report

// In: a mesh by places. Out: where its surface ends, where it folds, which triangles it has twice, and which
// of its shells lie in which.
#include "geometry/mesh_health_parts.h"
#include "geometry/mesh_shadow.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace sahl {

namespace {

constexpr std::size_t borders_shown = 5;
constexpr std::size_t shells_compared = 2000; // pair by pair: above this, nesting is not looked for

/// The side that goes on along the border after this one; `side` itself where the border ends at an edge of
/// more than two triangles.
std::uint32_t next_along_border(Sides const& sides, std::uint32_t side) {
    std::uint32_t corner = next_side(side);
    while (sides.is_joined(corner))
        corner = next_side(sides.across[corner]);
    return sides.across[corner] == Sides::border ? corner : side;
}

} // namespace

void find_borders(HealthView const& view, MeshHealth& health) {
    std::vector<bool> seen(view.sides.across.size(), false);
    for (std::uint32_t start = 0; start < view.sides.across.size(); ++start) {
        if (view.sides.across[start] != Sides::border || seen[start])
            continue;
        Border border;
        for (std::uint32_t side = start; !seen[side]; side = next_along_border(view.sides, side)) {
            seen[side] = true;
            double const size = length(view.at(next_side(side)) - view.at(side));
            border.length += size;
            border.centre += size * view.middle(side);
            ++border.edges;
        }
        if (border.length > 0.0)
            border.centre /= border.length;
        ShellHealth& shell = health.shells[view.shell_of(start / 3)];
        shell.closed = false;
        shell.volume = 0.0;
        shell.border_length += border.length;
        health.border_length += border.length;
        ++health.borders;
        auto& list = health.longest_borders;
        auto const place =
            std::upper_bound(list.begin(), list.end(), border,
                             [](Border const& a, Border const& b) { return a.length > b.length; });
        list.insert(place, border);
        if (list.size() > borders_shown)
            list.pop_back();
    }
}

/// The sides of a triangle and those of its copy lie at the same edges. So either each edge has more
/// triangles than two, or the pair is all there is and its members are each other's only neighbours.
void find_duplicates(HealthView const& view, MeshHealth& health) {
    std::vector<std::pair<Corners, std::uint32_t>> candidates;
    for (std::uint32_t t = 0; t < view.real(); ++t) {
        auto const* const across = &view.sides.across[3 * t];
        bool const crowded = std::count(across, across + 3, Sides::crowded) == 3;
        bool const paired = view.sides.is_joined(3 * t) && view.sides.is_joined(3 * t + 1) &&
                            view.sides.is_joined(3 * t + 2) && across[0] / 3 == across[1] / 3 &&
                            across[1] / 3 == across[2] / 3;
        if (!crowded && !paired)
            continue;
        Corners corners = view.corners[t];
        std::sort(corners.begin(), corners.end());
        candidates.emplace_back(corners, t);
    }
    std::sort(candidates.begin(), candidates.end());
    for (std::size_t i = 1; i < candidates.size(); ++i)
        if (candidates[i].first == candidates[i - 1].first)
            health.duplicates.add(view.centre(candidates[i].second));
}

std::vector<std::uint32_t> find_creases(HealthView const& view, MeshHealth& health) {
    static double const least_cosine = std::cos(MeshHealth::crease_angle);
    std::vector<std::uint32_t> across = view.sides.across;
    for (std::uint32_t side = 0; side < 3 * view.real(); ++side) {
        std::uint32_t const other = view.sides.across[side];
        if (other >= Sides::crowded || other < side || other / 3 >= view.real()) // each edge once
            continue;
        if (dot(view.normals[side / 3], view.normals[other / 3]) >= least_cosine)
            continue;
        ++health.creases;
        health.crease_length += length(view.at(next_side(side)) - view.at(side));
        across[side] = across[other] = Sides::border;
    }
    return across;
}

void nest_shells(HealthView const& view, MeshHealth& health) {
    std::size_t const count = health.shells.size();
    health.nesting_known = count <= shells_compared;
    if (count < 2 || !health.nesting_known)
        return;
    std::vector<std::uint32_t> first_triangle(count, Sides::border);
    for (std::uint32_t t = 0; t < view.real(); ++t)
        if (auto& first = first_triangle[view.mesh.triangle_shell[t]]; first == Sides::border)
            first = t;
    for (std::uint32_t outer = 0; outer < count; ++outer) {
        std::optional<Shadow> shadow; // made when something may be inside
        ShellHealth const& round = health.shells[outer];
        for (std::uint32_t inner = 0; round.closed && inner < count; ++inner) {
            dvec3 const point = view.centre(first_triangle[inner]);
            if (inner == outer || glm::min(point, round.low) != round.low ||
                glm::max(point, round.high) != round.high)
                continue;
            if (!shadow) {
                std::vector<Corners> triangles;
                for (std::uint32_t t = 0; t < view.real(); ++t)
                    if (view.mesh.triangle_shell[t] == outer)
                        triangles.push_back(view.corners[t]);
                shadow = make_shadow(view.places, triangles);
            }
            health.shells[inner].winding_outside += winding_number(*shadow, point);
        }
    }
}

} // namespace sahl

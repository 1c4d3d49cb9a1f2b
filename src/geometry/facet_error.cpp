// In: a mesh. Out: how far the smooth surface that it stands for may lie off each of its triangles; see
// facet_error.h.
#include "geometry/facet_error.h"

#include "geometry/mesh_weld.h"
#include "math/products.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace sahl {

std::vector<double> facet_errors(Mesh const& mesh) {
    constexpr double crease = 0.5235987755982988; // rad, 30°: where the mesh's health sees a crease too
    constexpr double flat = 1e-7;                 // rad: of a plane whose corners were rounded to float
    auto const& positions = mesh.soup.positions;
    std::vector<std::uint32_t> first;
    auto const place = number_kinds(
        positions.size(),
        [&](std::size_t i) {
            return std::array{std::bit_cast<std::uint64_t>(positions[i].x),
                              std::bit_cast<std::uint64_t>(positions[i].y),
                              std::bit_cast<std::uint64_t>(positions[i].z)};
        },
        first);
    struct Side {
        std::uint64_t edge;
        std::uint32_t triangle;
    };
    std::vector<Side> sides;
    std::vector<dvec3> across; // of each triangle: along its normal, as long as twice its area
    for (std::uint32_t t = 0; t < mesh.soup.triangles.size(); ++t) {
        auto const& corners = mesh.soup.triangles[t];
        across.push_back(precise_cross(positions[corners[1]] - positions[corners[0]],
                                       positions[corners[2]] - positions[corners[0]]));
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint64_t const a = place[corners[k]], b = place[corners[(k + 1) % 3]];
            sides.push_back({std::min(a, b) << 32 | std::max(a, b), t});
        }
    }
    std::sort(sides.begin(), sides.end(), [](Side const& a, Side const& b) { return a.edge < b.edge; });
    std::vector<double> errors(mesh.soup.triangles.size(), 0.0);
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        Side const &one = sides[i], &other = sides[i + 1];
        if (one.edge != other.edge)
            continue;
        dvec3 const &m = across[one.triangle], &n = across[other.triangle];
        double const angle = std::atan2(length(cross(m, n)), dot(m, n));
        if (!(angle > flat && angle < crease))
            continue;
        double const edge =
            length(positions[first[one.edge >> 32]] - positions[first[one.edge & 0xFFFFFFFFu]]);
        for (std::uint32_t const t : {one.triangle, other.triangle})
            errors[t] = std::max(errors[t], 0.5 * angle * length(across[t]) / edge);
    }
    return errors;
}

} // namespace sahl

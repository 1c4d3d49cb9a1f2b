// In: a mesh by places. Out: where its triangles go through each other, on meshes that this is cheap for.
#include "geometry/mesh_health_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sahl {

namespace {

constexpr std::uint64_t pairs_looked_at =
    50'000'000; // boxes compared along the sweep: a fraction of a second

struct Box {
    dvec3 low, high;
    std::uint32_t triangle;
};

/// Six times the volume of a tetrahedron; 0 where its sign may be rounding's.
double sure_volume(dvec3 const& a, dvec3 const& b, dvec3 const& c, dvec3 const& d) {
    dvec3 const u = b - a, v = c - a, w = d - a;
    double const volume = dot(u, cross(v, w));
    double const size = length(u) * length(v) * length(w);
    return std::abs(volume) > 1e-12 * size ? volume : 0.0; // some thousand ulp of the product
}

/// Does the segment pq go through the inside of the triangle?
bool pierces(dvec3 const& p, dvec3 const& q, std::array<dvec3, 3> const& t) {
    double const above = sure_volume(t[0], t[1], t[2], p), below = sure_volume(t[0], t[1], t[2], q);
    if (above * below >= 0.0)
        return false;
    double const a = sure_volume(p, q, t[0], t[1]), b = sure_volume(p, q, t[1], t[2]),
                 c = sure_volume(p, q, t[2], t[0]);
    return (a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0);
}

bool cross_each_other(std::array<dvec3, 3> const& one, std::array<dvec3, 3> const& other) {
    for (std::size_t i = 0; i < 3; ++i)
        if (pierces(one[i], one[(i + 1) % 3], other) || pierces(other[i], other[(i + 1) % 3], one))
            return true;
    return false;
}

bool share_a_place(Corners const& a, Corners const& b) {
    return std::any_of(a.begin(), a.end(),
                       [&](std::uint32_t place) { return std::find(b.begin(), b.end(), place) != b.end(); });
}

bool overlap(Box const& a, Box const& b) {
    return a.low.y <= b.high.y && b.low.y <= a.high.y && a.low.z <= b.high.z && b.low.z <= a.high.z;
}

} // namespace

std::optional<Found> find_self_intersections(HealthView const& view) {
    auto const corners = [&](std::uint32_t t) {
        Corners const& c = view.corners[t];
        return std::array<dvec3, 3>{view.places[c[0]], view.places[c[1]], view.places[c[2]]};
    };
    std::vector<Box> boxes;
    for (std::uint32_t t = 0; t < view.real(); ++t) {
        auto const [a, b, c] = corners(t);
        boxes.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), t});
    }
    std::sort(boxes.begin(), boxes.end(), [](Box const& a, Box const& b) { return a.low.x < b.low.x; });
    Found found;
    std::uint64_t looked_at = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size() && boxes[j].low.x <= boxes[i].high.x; ++j) {
            if (++looked_at > pairs_looked_at)
                return std::nullopt;
            std::uint32_t const one = boxes[i].triangle, other = boxes[j].triangle;
            if (overlap(boxes[i], boxes[j]) && !share_a_place(view.corners[one], view.corners[other]) &&
                cross_each_other(corners(one), corners(other)))
                found.add(0.5 * (view.centre(one) + view.centre(other)));
        }
    return found;
}

} // namespace sahl

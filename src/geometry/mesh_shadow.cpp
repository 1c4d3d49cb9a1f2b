// In: a closed surface, and points. Out: winding numbers. Neighbouring triangles share one value for the side
// of their edge on which the line passes, so that none is missed between them and none counted twice.
#include "geometry/mesh_shadow.h"

#include <algorithm>
#include <tuple>

namespace sahl {

namespace {

/// Coordinates in which the line is along z. Its direction has no simple ratio, so that the edges of boxes
/// and grids do not line up with it; any rotation would do.
dvec3 slanted(dvec3 const& p) {
    static dvec3 const along = normalize(dvec3(0.53772, 0.31187, 0.78333));
    static dvec3 const side = perpendicular_to(along, dvec3(0.27, 0.91, -0.13));
    static dvec3 const other = cross(along, side);
    return {dot(p, side), dot(p, other), dot(p, along)};
}

/// > 0 where `p` is to the left of the way from `a` to `b`, seen against z; the exact opposite from `b` to
/// `a`.
bool is_left(dvec3 const& a, dvec3 const& b, dvec3 const& p) {
    bool const ordered = std::tie(a.x, a.y) < std::tie(b.x, b.y);
    dvec3 const &low = ordered ? a : b, &high = ordered ? b : a;
    bool const left = (high.x - low.x) * (p.y - low.y) - (high.y - low.y) * (p.x - low.x) >= 0.0;
    return left == ordered;
}

/// The height of the triangle's plane over `p`.
double height_at(std::array<dvec3, 3> const& corners, dvec3 const& p) {
    dvec3 const normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    dvec3 const from = p - corners[0];
    return corners[0].z - (normal.x * from.x + normal.y * from.y) / normal.z;
}

} // namespace

Shadow make_shadow(std::span<dvec3 const> positions,
                   std::span<std::array<std::uint32_t, 3> const> triangles) {
    Shadow shadow;
    shadow.triangles.reserve(triangles.size());
    for (auto const& t : triangles) {
        std::array<dvec3, 3> const c{slanted(positions[t[0]]), slanted(positions[t[1]]),
                                     slanted(positions[t[2]])};
        shadow.triangles.push_back(
            {std::min({c[0].x, c[1].x, c[2].x}), std::max({c[0].x, c[1].x, c[2].x}), c});
        shadow.widest = std::max(shadow.widest, shadow.triangles.back().end - shadow.triangles.back().begin);
    }
    std::sort(shadow.triangles.begin(), shadow.triangles.end(),
              [](auto const& a, auto const& b) { return a.begin < b.begin; });
    return shadow;
}

int winding_number(Shadow const& shadow, dvec3 const& point) {
    dvec3 const p = slanted(point);
    auto const by_begin = [](Shadow::Triangle const& t, double x) { return t.begin < x; };
    // one ulp and more of slack: begin + widest may round below end
    auto t = std::lower_bound(shadow.triangles.begin(), shadow.triangles.end(),
                              p.x - 1.000001 * shadow.widest, by_begin);
    int winding = 0;
    for (; t != shadow.triangles.end() && t->begin <= p.x; ++t) {
        if (t->end < p.x)
            continue;
        auto const& c = t->corners;
        bool const left = is_left(c[0], c[1], p);
        if (is_left(c[1], c[2], p) == left && is_left(c[2], c[0], p) == left && height_at(c, p) > p.z)
            winding += left ? 1 : -1;
    }
    return winding;
}

} // namespace sahl

#include "geometry/mesh_sheet.h"

#include "geometry/triangle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sahl {

namespace {

TriangleCorners corners_of(Mesh const& mesh, std::uint32_t triangle) {
    auto const& [a, b, c] = mesh.soup.triangles[triangle];
    return {mesh.soup.positions[a], mesh.soup.positions[b], mesh.soup.positions[c]};
}

std::vector<Bounds> triangle_bounds(Mesh const& mesh) {
    std::vector<Bounds> bounds;
    bounds.reserve(mesh.soup.triangles.size());
    for (std::uint32_t t = 0; t < mesh.soup.triangles.size(); ++t) {
        auto const [p, q, r] = corners_of(mesh, t);
        bounds.push_back({glm::min(p, glm::min(q, r)), glm::max(p, glm::max(q, r))});
    }
    return bounds;
}

} // namespace

MeshSheet::MeshSheet(std::shared_ptr<Mesh const> mesh)
    : mesh_(std::move(mesh)), tree_(triangle_bounds(*mesh_)) {}

dvec3 MeshSheet::normal(std::uint32_t triangle) const {
    return normal_of(corners_of(*mesh_, triangle));
}

dvec3 MeshSheet::onto(std::uint32_t triangle, dvec3 const& point) const {
    return onto_triangle(corners_of(*mesh_, triangle), point);
}

/// By the volumes that the line spans with each edge. A line that misses a triangle by no more than rounding
/// meets it: of several round an edge or a vertex one is met at least, and they are met at one place.
std::optional<SheetMeeting> MeshSheet::meet(dvec3 const& origin, dvec3 const& direction, double rounding,
                                            std::uint32_t triangle) const {
    auto const [p, q, r] = corners_of(*mesh_, triangle);
    dvec3 const a = p - origin, b = q - origin, c = r - origin;
    double const u = dot(direction, cross(c, b)), v = dot(direction, cross(a, c)),
                 w = dot(direction, cross(b, a));
    if (std::min({u, v, w}) < 0.0 && std::max({u, v, w}) > 0.0) {
        double const margin = rounding * length(direction);
        dvec3 const margins = margin * dvec3(length(r - q), length(p - r), length(q - p));
        auto const near = [&](double sense) {
            return sense * u >= -margins.x && sense * v >= -margins.y && sense * w >= -margins.z;
        };
        if (!near(1.0) && !near(-1.0))
            return std::nullopt;
    }
    dvec3 const normal = precise_cross(q - p, r - p);
    double const along = dot(normal, direction), sum = u + v + w;
    if (along == 0.0 || sum == 0.0) // it runs along the triangle
        return std::nullopt;
    double const squared = dot(direction, direction);
    auto const [low, high] =
        std::minmax({dot(a, direction) / squared, dot(b, direction) / squared, dot(c, direction) / squared});
    SheetMeeting meeting;
    meeting.t = std::clamp(dot(normal, a) / along, low, high);
    meeting.slope = std::abs(along) / length(normal);
    meeting.range = high - low;
    meeting.uv = glm::clamp(dvec2(v, w) / sum, 0.0, 1.0);
    meeting.triangle = triangle;
    meeting.against = along < 0.0;
    return meeting;
}

std::optional<SheetMeeting> MeshSheet::next(dvec3 const& origin, dvec3 const& direction, Reach reach,
                                            double rounding, std::optional<bool> above) const {
    std::optional<SheetMeeting> best;
    AheadOnSheet const ahead{reach, rounding, above};
    tree_.visit(origin, direction, {ahead.start(direction), reach.to},
                [&](std::uint32_t triangle, double to) {
                    auto const m = meet(origin, direction, rounding, triangle);
                    if (!m || m->t > to || !ahead.holds(m->t, m->slope, m->against))
                        return to;
                    if (!best || std::pair(m->t, triangle) < std::pair(best->t, best->triangle))
                        best = m;
                    return std::min(to, best->t);
                });
    return best;
}

std::optional<bool> MeshSheet::heads_above(dvec3 const& point, dvec3 const& direction,
                                           double rounding) const {
    std::optional<bool> answer;
    double nearest = rounding;
    // a short line through the point, long enough for every box that comes within rounding of it
    dvec3 const along(1.0, 0.0, 0.0);
    tree_.visit(point, along, {-2.0 * rounding, 2.0 * rounding}, [&](std::uint32_t triangle, double to) {
        double const distance = length(onto(triangle, point) - point);
        if (distance <= nearest) {
            nearest = distance;
            answer = dot(normal(triangle), direction) > 0.0;
        }
        return to;
    });
    return answer;
}

} // namespace sahl

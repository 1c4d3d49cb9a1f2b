#include "geometry/mesh_contact.h"

#include "geometry/box_pairs.h"
#include "math/products.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace sahl {

namespace {

using Triangle = std::array<dvec3, 3>;

/// Units in the last place of a float that one surface written twice, through other transforms, may lie
/// apart: each time a product with a matrix in float and a rounding of the result.
constexpr double float_ulps = 4.0;

/// Of a coordinate that was read as a float, one unit in its last place; 0 for a number of so few digits that
/// it is meant as it stands (1, 0.5, 0.375): by chance one float in 4096 is.
double float_ulp(double x) {
    auto const bits = std::bit_cast<std::uint32_t>(static_cast<float>(x));
    std::uint32_t const exponent = bits >> 23 & 0xFF;
    if ((bits & 0xFFF) == 0 || exponent <= 23)
        return 0.0;
    return std::bit_cast<float>((exponent - 23) << 23);
}

/// Triangles of a mesh that reach into a region, seen in one frame.
struct Seen {
    std::vector<std::uint32_t> number; // in the mesh
    std::vector<Triangle> corners;
    std::vector<dvec3> normals; // unit
    std::vector<Bounds> boxes;
};

Bounds box_of(Triangle const& t) {
    return {glm::min(t[0], glm::min(t[1], t[2])), glm::max(t[0], glm::max(t[1], t[2]))};
}

Bounds grown(Bounds const& box, double by) {
    return {box.low - by, box.high + by};
}

Bounds common(Bounds const& a, Bounds const& b) {
    return {glm::max(a.low, b.low), glm::min(a.high, b.high)};
}

std::vector<dvec3> mapped(std::vector<dvec3> points, Affine const& map) {
    if (!(map == Affine{}))
        for (dvec3& point : points)
            point = map.point(point);
    return points;
}

Bounds bounds_of(std::vector<dvec3> const& points) {
    Bounds all{dvec3(INFINITY), dvec3(-INFINITY)};
    for (dvec3 const& point : points)
        all = joined(all, {point, point});
    return all;
}

Seen triangles_in(Mesh const& mesh, std::vector<dvec3> const& positions, Bounds const& region) {
    Seen seen;
    for (std::uint32_t t = 0; t < mesh.soup.triangles.size(); ++t) {
        auto const& [a, b, c] = mesh.soup.triangles[t];
        Triangle const corners{positions[a], positions[b], positions[c]};
        Bounds const box = box_of(corners);
        if (!overlap(box, region))
            continue;
        seen.number.push_back(t);
        seen.corners.push_back(corners);
        seen.normals.push_back(normalize(precise_cross(corners[1] - corners[0], corners[2] - corners[0])));
        seen.boxes.push_back(box);
    }
    return seen;
}

double farthest_off(Triangle const& points, dvec3 const& normal, dvec3 const& on_plane) {
    double farthest = 0.0;
    for (dvec3 const& point : points)
        farthest = std::max(farthest, std::abs(dot(normal, point - on_plane)));
    return farthest;
}

/// How far apart corresponding corners are; nothing where they do not correspond.
std::optional<double> corners_apart(Triangle const& a, Triangle const& b, double allowed) {
    double farthest = 0.0;
    for (dvec3 const& corner : a) {
        double const nearest =
            std::min({length(corner - b[0]), length(corner - b[1]), length(corner - b[2])});
        if (nearest > allowed)
            return std::nullopt;
        farthest = std::max(farthest, nearest);
    }
    return farthest;
}

/// Do two triangles of one plane have more than a border in common? By the axes across their sides.
bool overlap_in_plane(Triangle const& a, Triangle const& b, dvec3 const& normal, double allowed) {
    for (Triangle const* triangle : {&a, &b})
        for (std::size_t i = 0; i < 3; ++i) {
            dvec3 const axis = normalize(cross(normal, (*triangle)[(i + 1) % 3] - (*triangle)[i]));
            double a_low = INFINITY, a_high = -INFINITY, b_low = INFINITY, b_high = -INFINITY;
            for (std::size_t k = 0; k < 3; ++k) {
                double const on_a = dot(axis, a[k] - a[0]), on_b = dot(axis, b[k] - a[0]);
                a_low = std::min(a_low, on_a);
                a_high = std::max(a_high, on_a);
                b_low = std::min(b_low, on_b);
                b_high = std::max(b_high, on_b);
            }
            if (std::min(a_high, b_high) - std::max(a_low, b_low) <= 2.0 * allowed)
                return false;
        }
    return true;
}

/// By axis, the largest unit in the last place of the corners' coordinates.
dvec3 grain_of(Triangle const& corners) {
    dvec3 grain(0.0);
    for (dvec3 const& corner : corners)
        grain = glm::max(grain, dvec3(float_ulp(corner.x), float_ulp(corner.y), float_ulp(corner.z)));
    return grain;
}

/// The same seen through a map: a turn mixes the axes, and was itself rounded.
dvec3 grain_through(dvec3 const& grain, dmat3 const& map) {
    bool turned = false;
    dvec3 seen(0.0);
    double largest = 0.0;
    for (int column = 0; column < 3; ++column) {
        int parts = 0;
        for (int row = 0; row < 3; ++row) {
            double const part = std::abs(map[column][row]);
            parts += part > 0x1p-40 * length(map[column]); // a quarter turn's cosine is not quite zero
            seen[row] = std::max(seen[row], part * grain[column]);
        }
        turned = turned || parts > 1;
        largest = std::max(largest, length(map[column]));
    }
    return turned ? dvec3(largest * std::max({grain.x, grain.y, grain.z})) : seen;
}

Triangle own_corners(Mesh const& mesh, std::uint32_t triangle) {
    auto const& [a, b, c] = mesh.soup.triangles[triangle];
    return {mesh.soup.positions[a], mesh.soup.positions[b], mesh.soup.positions[c]};
}

/// Finds out how two triangles fit, by ever dearer tests.
struct Fitter {
    Mesh const &one, &other;
    Affine const& other_to_one;
    FitTolerance const& tolerance;
    double largest; // m: no pair may be farther apart

    std::optional<TriangleFit> operator()(Seen const& a, std::uint32_t i, Seen const& b,
                                          std::uint32_t j) const {
        Triangle const &p = a.corners[i], &q = b.corners[j];
        TriangleFit fit{a.number[i], b.number[j]};
        if (auto const apart = corners_apart(p, q, 2.0 * largest)) {
            fit.apart = *apart;
            fit.same_corners = true;
            fit.corner_tolerance = fit.tolerance = tolerance.placing + float_ulps * length(grain_at(fit));
            if (fit.apart <= fit.tolerance)
                return fit;
            fit.same_corners = false; // nearly: along their plane they are really apart
        }
        if (std::abs(dot(a.normals[i], b.normals[j])) < 0.5)
            return std::nullopt;
        // either may be the larger, whose plane is the more exact
        double const p_off = farthest_off(p, b.normals[j], q[0]), q_off = farthest_off(q, a.normals[i], p[0]);
        fit.apart = std::min(p_off, q_off);
        if (fit.apart > largest)
            return across(a, i, b, j);
        dvec3 const& normal = p_off < q_off ? b.normals[j] : a.normals[i];
        dvec3 const grain = grain_at(fit);
        fit.tolerance = tolerance.placing + float_ulps * length(normal * grain);
        fit.corner_tolerance = tolerance.placing + float_ulps * length(grain);
        if (fit.apart > fit.tolerance)
            return across(a, i, b, j);
        return overlap_in_plane(p, q, normal, fit.tolerance) ? std::optional(fit) : std::nullopt;
    }
    /// Halves of a quad that is cut along different diagonals.
    std::optional<TriangleFit> across(Seen const& a, std::uint32_t i, Seen const& b, std::uint32_t j) const {
        Triangle const &p = a.corners[i], &q = b.corners[j];
        InlineVector<std::size_t, 3> shared;
        std::size_t p_only = 0;
        dvec3 q_only = q[0] + q[1] + q[2];
        for (std::size_t k = 0; k < 3; ++k) {
            auto const apart = [&](dvec3 const& corner) { return length(p[k] - corner); };
            dvec3 const& nearest = *std::min_element(
                q.begin(), q.end(), [&](auto const& c, auto const& d) { return apart(c) < apart(d); });
            if (apart(nearest) > largest) {
                p_only = k;
                continue;
            }
            shared.push_back(k);
            q_only -= nearest;
        }
        if (shared.size() != 2)
            return std::nullopt;
        dvec3 const& corner = p[shared[0]];
        dvec3 const side = cross(a.normals[i], p[shared[1]] - corner);
        if (dot(side, p[p_only] - corner) * dot(side, q_only - corner) <= 0.0)
            return std::nullopt;
        TriangleFit fit{a.number[i], b.number[j], INFINITY};
        fit.corner_tolerance = tolerance.placing + float_ulps * length(grain_at(fit));
        fit.other_diagonal = true;
        return fit;
    }
    dvec3 grain_at(TriangleFit const& fit) const {
        dvec3 grain(0.0);
        if (tolerance.one_is_float)
            grain = grain_of(own_corners(one, fit.one));
        if (tolerance.other_is_float)
            grain =
                glm::max(grain, grain_through(grain_of(own_corners(other, fit.other)), other_to_one.linear));
        return grain;
    }
};

double largest_grain(Mesh const& mesh) {
    dvec3 const most = glm::max(glm::abs(mesh.low), glm::abs(mesh.high));
    return 0x1p-23 * std::max({most.x, most.y, most.z});
}

double size_of(dmat3 const& m) {
    return std::max({length(m[0]), length(m[1]), length(m[2])});
}

} // namespace

bool has_float_positions(Mesh const& mesh) {
    // a float's 23 digits leave the last 29 of a double's 52 empty
    auto const is_float = [](double x) { return (std::bit_cast<std::uint64_t>(x) & 0x1FFFFFFF) == 0; };
    return std::all_of(mesh.soup.positions.begin(), mesh.soup.positions.end(),
                       [&](dvec3 const& p) { return is_float(p.x) && is_float(p.y) && is_float(p.z); });
}

std::vector<TriangleFit> fits_of(Mesh const& one, Mesh const& other, Affine const& other_to_one,
                                 FitTolerance const& tolerance) {
    double largest = tolerance.placing;
    if (tolerance.one_is_float)
        largest += 2.0 * float_ulps * largest_grain(one);
    if (tolerance.other_is_float)
        largest += 2.0 * float_ulps * size_of(other_to_one.linear) * largest_grain(other);
    std::vector<dvec3> const others = mapped(other.soup.positions, other_to_one);
    Bounds const region = grown(common({one.low, one.high}, bounds_of(others)), largest);
    std::vector<TriangleFit> fits;
    Seen const b = triangles_in(other, others, region);
    if (b.number.empty())
        return fits;
    Seen const a = triangles_in(one, one.soup.positions, region);
    BoxHalves const halves(b.boxes);
    Fitter const fitter{one, other, other_to_one, tolerance, largest};
    // once both lie on something flat, another fit would tell nothing new: the triangles of two fans all
    // overlap
    std::vector<bool> a_lies(a.number.size(), false), b_lies(b.number.size(), false);
    for (std::uint32_t i = 0; i < a.number.size(); ++i)
        halves.visit(grown(a.boxes[i], largest), [&](std::uint32_t j) {
            if (a_lies[i] && b_lies[j])
                return;
            if (auto const fit = fitter(a, i, b, j)) {
                fits.push_back(*fit);
                if (!fit->same_corners && !fit->other_diagonal)
                    a_lies[i] = b_lies[j] = true;
            }
        });
    return fits;
}

std::vector<TriangleFit> fits_of(Mesh const& mesh, PlaneCarrier const& plane, Bounds const& region,
                                 FitTolerance const& tolerance) {
    double const largest =
        tolerance.placing + (tolerance.one_is_float ? 2.0 * float_ulps * largest_grain(mesh) : 0.0);
    dvec3 const on_plane = plane.offset * plane.normal;
    std::vector<TriangleFit> fits;
    for (std::uint32_t t = 0; t < mesh.soup.triangles.size(); ++t) {
        Triangle const corners = own_corners(mesh, t);
        TriangleFit fit{t, 0, farthest_off(corners, plane.normal, on_plane)};
        if (fit.apart > largest || !overlap(box_of(corners), grown(region, largest)))
            continue;
        fit.tolerance = tolerance.placing;
        if (tolerance.one_is_float)
            fit.tolerance += float_ulps * length(plane.normal * grain_of(corners));
        if (fit.apart <= fit.tolerance)
            fits.push_back(fit);
    }
    return fits;
}

} // namespace sahl

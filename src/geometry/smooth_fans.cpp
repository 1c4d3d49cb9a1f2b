#include "geometry/smooth_fans.h"

#include "geometry/mesh_health_parts.h"
#include "geometry/patch_fit.h"
#include "geometry/triangle.h"
#include "math/joined_sets.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sahl {

namespace {

/// rad: normals at one place that differ by more than this across an edge say that it is a crease. Far above
/// what a coarse format's rounding does to equal normals, far below a facet's edge that is meant.
constexpr double split_angle = 5e-3;

double angle(dvec3 const& a, dvec3 const& b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

/// Were the places read as floats? Some may have been moved since, onto what the mesh touches.
bool were_floats(std::span<dvec3 const> places) {
    std::size_t floats = 0;
    for (dvec3 const& p : places) {
        auto const low_bits = [](double x) { return std::bit_cast<std::uint64_t>(x) & 0x1FFFFFFF; };
        floats += (low_bits(p.x) | low_bits(p.y) | low_bits(p.z)) == 0; // a double's last 29 of 52
    }
    return 10 * floats >= places.size();
}

double median_of(std::vector<double> values) {
    if (values.empty())
        return 0.0;
    auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

dvec3 const& file_normal(HealthView const& view, std::uint32_t corner) {
    return view.mesh.soup.normals[view.mesh.soup.triangles[corner / 3][corner % 3]];
}

/// Where the file's normals differ across an edge they mark a crease.
void split_by_normals(HealthView const& view, std::vector<std::uint32_t>& across) {
    for (std::uint32_t side = 0; side < 3 * view.real(); ++side) {
        std::uint32_t const other = across[side];
        if (other >= Sides::crowded || other < side || other / 3 >= view.real())
            continue;
        if (angle(file_normal(view, side), file_normal(view, next_side(other))) > split_angle ||
            angle(file_normal(view, next_side(side)), file_normal(view, other)) > split_angle)
            across[side] = across[other] = Sides::border;
    }
}

/// Are they the triangles' own? Of a fine mesh every normal is near those, and it tells that they are nearer
/// than the triangle across is.
bool normals_are_flat(HealthView const& view) {
    std::size_t flat = 0;
    for (std::uint32_t corner = 0; corner < 3 * view.real(); ++corner) {
        dvec3 const& own = view.normals[corner / 3];
        double const off = angle(file_normal(view, corner), own);
        std::uint32_t const other = view.sides.across[corner];
        double const turns = other < Sides::crowded && other / 3 < view.real()
                                 ? angle(own, view.normals[other / 3])
                                 : INFINITY;
        flat += off < 1e-3 && (off < 0.1 * turns || off < 1e-6);
    }
    return 10 * flat >= 9 * 3 * view.real();
}

/// Σ (e₁×e₂) / (|e₁|²|e₂|²) (N. Max, J. Graphics Tools 4 (1999) 1): exact on a sphere.
dvec3 max_normal(HealthView const& view, std::span<std::uint32_t const> fan) {
    dvec3 sum(0.0), plain(0.0);
    for (std::uint32_t const corner : fan) {
        if (corner / 3 >= view.real())
            continue;
        dvec3 const at = view.at(corner);
        dvec3 const e1 = view.at(next_side(corner)) - at, e2 = view.at(previous_side(corner)) - at;
        sum += cross(e1, e2) / (dot(e1, e1) * dot(e2, e2));
        plain += view.normals[corner / 3];
    }
    double const size = length(sum);
    return size > 0.0 && std::isfinite(size) ? sum / size : normalize(plain);
}

/// One for all corners of a fan, from their vertices, on the side of the triangles.
dvec3 fan_normal(HealthView const& view, std::span<std::uint32_t const> fan, bool from_file) {
    dvec3 const by_positions = max_normal(view, fan);
    if (!from_file)
        return by_positions;
    dvec3 sum(0.0);
    for (std::uint32_t const corner : fan)
        if (corner / 3 < view.real()) {
            dvec3 const& normal = file_normal(view, corner);
            sum += dot(normal, by_positions) < 0.0 ? -normal : normal;
        }
    double const size = length(sum);
    return size > 0.0 && std::isfinite(size) ? sum / size : by_positions;
}

/// m: of a triangle at a fan.
double edge_at(SmoothFans const& fans, Fan const& fan) {
    SmoothTriangle const& triangle = fans.triangles[fans.corners[fan.first_corner]];
    return length(fans.fans[triangle.fans[1]].place - fans.fans[triangle.fans[0]].place);
}

/// The file's normals against those of polynomials through the positions alone, and these against lesser
/// ones: by how much the first disagree, and how far the second can be trusted. What rounding to floats does
/// to the positions both polynomials share: an eighth of an ulp over an edge is left of it by the fit.
void compare_with_positions(SmoothFans& fans) {
    constexpr std::size_t sample = 512;
    std::size_t const stride = std::max<std::size_t>(1, fans.fans.size() / sample);
    double const rounding = fans.float_positions ? 0x1p-26 * fans.reach : 0.0;
    std::vector<double> off, blur;
    for (std::size_t i = 0; i < fans.fans.size(); i += stride) {
        auto const normal = [&](int degree) -> std::optional<dvec3> {
            auto const field = fit_at(fans, static_cast<std::uint32_t>(i), {degree, false});
            if (!field)
                return std::nullopt;
            dvec3 gradient;
            field->above(field->origin, gradient);
            return normalize(gradient);
        };
        auto const best = normal(4), lesser = normal(3);
        if (!best || !lesser)
            continue;
        off.push_back(angle(fans.fans[i].normal, *best));
        blur.push_back(std::max(angle(*lesser, *best), rounding / edge_at(fans, fans.fans[i])));
    }
    fans.normals_off = median_of(std::move(off));
    fans.positions_blur = median_of(std::move(blur));
}

void number_groups(SmoothFans& fans, std::vector<std::uint32_t> const& across) {
    JoinedSets sets(fans.triangles.size());
    for (std::uint32_t side = 0; side < 3 * fans.triangles.size(); ++side)
        if (across[side] < Sides::crowded && across[side] / 3 < fans.triangles.size())
            sets.join(side / 3, across[side] / 3);
    std::vector<std::uint32_t> number(fans.triangles.size(), Sides::border);
    for (std::uint32_t t = 0; t < fans.triangles.size(); ++t) {
        std::uint32_t& of_root = number[sets.find(t)];
        if (of_root == Sides::border)
            of_root = fans.groups++;
        fans.group.push_back(of_root);
    }
}

/// Fans and creases from what lies across each side, creases as borders.
void gather(SmoothFans& fans, HealthView const& view, std::vector<std::uint32_t> const& across,
            bool from_file) {
    Mesh const& mesh = *fans.mesh;
    fans.fans.clear();
    fans.corners.clear();
    fans.triangles.assign(view.real(), {});
    auto const turned = [&](std::uint32_t triangle) { return mesh.shells[mesh.shell_of(triangle)].sign < 0; };
    for_each_fan(across, [&](std::span<std::uint32_t const> corners) {
        Fan fan;
        fan.first_corner = static_cast<std::uint32_t>(fans.corners.size());
        std::uint32_t first = Sides::border;
        for (std::uint32_t const corner : corners) {
            std::uint32_t const triangle = corner / 3, k = corner % 3;
            if (triangle >= view.real()) // it was dropped as flat
                continue;
            first = std::min(first, corner);
            fans.corners.push_back(triangle);
            fans.triangles[triangle].fans[turned(triangle) && k != 0 ? 3 - k : k] =
                static_cast<std::uint32_t>(fans.fans.size());
        }
        if (first == Sides::border)
            return;
        fan.corners = static_cast<std::uint32_t>(fans.corners.size()) - fan.first_corner;
        fan.place = view.at(first);
        fan.normal = fan_normal(view, corners, from_file);
        if (turned(first / 3))
            fan.normal = -fan.normal;
        fans.fans.push_back(fan);
    });
    for (std::uint32_t side = 0; side < 3 * view.real(); ++side) {
        std::uint32_t const opposite = previous_side(side) % 3; // the corner that the side lies opposite of
        std::uint32_t const k = turned(side / 3) && opposite != 0 ? 3 - opposite : opposite;
        SmoothTriangle& triangle = fans.triangles[side / 3];
        if (across[side] >= Sides::crowded || across[side] / 3 >= view.real())
            triangle.creases |= static_cast<std::uint8_t>(1u << k);
        else
            triangle.beside[k] = across[side] / 3;
    }
}

} // namespace

double height_noise(SmoothFans const& fans) {
    return fans.reach * (fans.float_positions ? 0x1p-22 : 0x1p-46);
}

SmoothFans smooth_fans(std::shared_ptr<Mesh const> mesh) {
    SmoothFans fans;
    fans.mesh = std::move(mesh);
    HealthView view = view_of(*fans.mesh);
    for (std::uint32_t t = 0; t < view.real(); ++t)
        view.normals.push_back(normal_of({view.at(3 * t), view.at(3 * t + 1), view.at(3 * t + 2)}));
    MeshHealth ignored;
    std::vector<std::uint32_t> const by_angle = find_creases(view, ignored);
    fans.float_positions = were_floats(fans.mesh->soup.positions);
    for (dvec3 const* const corner : {&fans.mesh->low, &fans.mesh->high})
        fans.reach = std::max({fans.reach, std::abs(corner->x), std::abs(corner->y), std::abs(corner->z)});
    bool const has_normals = !fans.mesh->soup.normals.empty();
    std::vector<std::uint32_t> across = by_angle;
    fans.normals = !has_normals             ? NormalUse::none
                   : normals_are_flat(view) ? NormalUse::flat
                                            : NormalUse::files;
    if (fans.normals == NormalUse::files)
        split_by_normals(view, across);
    gather(fans, view, across, fans.normals == NormalUse::files);
    if (fans.normals == NormalUse::files) {
        // the positions' normals are trusted to what a lesser polynomial makes of them; a factor of 4 is
        // margin, for a mesh too coarse for either
        compare_with_positions(fans);
        if (fans.normals_off > 4.0 * fans.positions_blur + 1e-6) {
            fans.normals = NormalUse::first_order;
            across = by_angle;
            gather(fans, view, across, false);
        }
    }
    number_groups(fans, across);
    return fans;
}

} // namespace sahl

#include "geometry/recognise.h"

#include "geometry/mesh_shadow.h"
#include "geometry/quadric.h"
#include "geometry/region.h"
#include "math/random.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sahl {

namespace {

/// Ulps of float coordinates, relative to the largest; a float ulp is 2⁻²³ of it at most.
constexpr double residual_ulps = 4.0 * 0x1p-23;
constexpr double normals_agree = 1e-6; // rad: float normals are off by a tenth of it
constexpr std::size_t most_regions = 6;

/// Of one smooth piece.
struct Piece {
    std::vector<dvec3> places, normals; // out of the body
    std::uint32_t face = 0;
    bool one_face = true;
    dvec3 centre{0.0};
};

/// The unit eigenvector of the least eigenvalue of a symmetric matrix, by Jacobi's rotations.
dvec3 least_direction(dmat3 a) {
    dmat3 v(1.0);
    for (int sweep = 0; sweep < 30; ++sweep)
        for (auto const& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
            if (std::abs(a[q][p]) <= 1e-18 * (std::abs(a[p][p]) + std::abs(a[q][q])))
                continue;
            double const theta = 0.5 * (a[q][q] - a[p][p]) / a[q][p];
            double const t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
            double const c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
            dmat3 turn(1.0);
            turn[p][p] = turn[q][q] = c;
            turn[q][p] = s;
            turn[p][q] = -s;
            a = glm::transpose(turn) * a * turn;
            v = v * turn;
        }
    int best = 0;
    for (int k = 1; k < 3; ++k)
        if (a[k][k] < a[best][best])
            best = k;
    return normalize(v[best]);
}

template <std::size_t n>
using Unknowns = std::array<double, n>;

/// Normal equations of a linear least squares problem of few unknowns, well scaled.
template <std::size_t n>
struct Equations {
    std::array<std::array<double, n + 1>, n> rows{};
    void add(Unknowns<n> const& row, double right) {
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j)
                rows[i][j] += row[i] * row[j];
            rows[i][n] += row[i] * right;
        }
    }
    std::optional<Unknowns<n>> solved() {
        for (std::size_t k = 0; k < n; ++k) {
            std::size_t pivot = k;
            for (std::size_t i = k + 1; i < n; ++i)
                if (std::abs(rows[i][k]) > std::abs(rows[pivot][k]))
                    pivot = i;
            std::swap(rows[k], rows[pivot]);
            if (!(std::abs(rows[k][k]) > 1e-300))
                return std::nullopt;
            for (std::size_t i = 0; i < n; ++i)
                if (i != k) {
                    double const by = rows[i][k] / rows[k][k];
                    for (std::size_t j = k; j <= n; ++j)
                        rows[i][j] -= by * rows[k][j];
                }
        }
        Unknowns<n> x{};
        for (std::size_t k = 0; k < n; ++k)
            x[k] = rows[k][n] / rows[k][k];
        return x;
    }
};

struct Found {
    Region region;
    std::optional<Quadric> quadric;
    std::optional<Region> behind; // of a hollow sphere: the side of its centre that the body is on
};

double worst(Piece const& piece, auto const& distance) {
    double most = 0.0;
    for (dvec3 const& p : piece.places)
        most = std::max(most, std::abs(distance(p)));
    return most;
}

double worst_normal(Piece const& piece, auto const& normal_at) {
    double most = 0.0;
    for (std::size_t i = 0; i < piece.places.size(); ++i) {
        dvec3 const n = normal_at(piece.places[i]);
        most = std::max(most, length(piece.normals[i] - (dot(n, piece.normals[i]) < 0.0 ? -n : n)));
    }
    return most;
}

struct Judge {
    double tolerance; // m
    bool normals;
    double reach; // m
    double residual = 0.0, normals_off = 0.0;

    bool accepts(Piece const& piece, auto const& distance, auto const& normal_at) {
        double const off = worst(piece, distance);
        double const turned = normals ? worst_normal(piece, normal_at) : 0.0;
        if (!(off <= tolerance) || !(turned <= normals_agree))
            return false;
        residual = std::max(residual, off);
        normals_off = std::max(normals_off, turned);
        return true;
    }
};

std::optional<Found> as_plane(Piece const& piece, Judge& judge) {
    dmat3 scatter(0.0);
    for (dvec3 const& p : piece.places)
        scatter += glm::outerProduct(p - piece.centre, p - piece.centre);
    dvec3 normal = least_direction(scatter);
    if (dot(normal, piece.normals.front()) < 0.0)
        normal = -normal;
    double const offset = dot(normal, piece.centre);
    if (!judge.accepts(
            piece, [&](dvec3 const& p) { return dot(normal, p) - offset; },
            [&](dvec3 const&) { return normal; }))
        return std::nullopt;
    return Found{{Region::Kind::half_space, normal, offset, 0.0}, {}, {}};
}

Quadric outside_of_ball(double radius) {
    return {dmat3(-1.0), dvec3(0.0), radius * radius, dvec3(0.0)};
}

std::optional<Found> as_sphere(Piece const& piece, Judge& judge) {
    if (piece.places.size() < 5)
        return std::nullopt;
    double size = 0.0;
    for (dvec3 const& p : piece.places)
        size = std::max(size, length(p - piece.centre));
    Equations<4> algebraic; // |x|² = 2 c·x + k
    for (dvec3 const& p : piece.places) {
        dvec3 const x = (p - piece.centre) / size;
        algebraic.add({2.0 * x.x, 2.0 * x.y, 2.0 * x.z, 1.0}, dot(x, x));
    }
    auto const first = algebraic.solved();
    if (!first)
        return std::nullopt;
    dvec3 c((*first)[0], (*first)[1], (*first)[2]);
    double radius = std::sqrt(std::max((*first)[3] + dot(c, c), 0.0));
    if (!(radius > 0.0) || !std::isfinite(radius) || radius > 1e4)
        return std::nullopt;
    bool const normals = judge.normals;
    double const reach = judge.reach;
    double const outwards =
        dot(piece.normals.front(), (piece.places.front() - piece.centre) / size - c) < 0.0 ? -1.0 : 1.0;
    for (int pass = 0; pass < 4; ++pass) { // Gauss and Newton on distances
        Equations<4> step;
        for (dvec3 const& p : piece.places) {
            dvec3 const from = (p - piece.centre) / size - c;
            double const r = length(from);
            step.add({-from.x / r, -from.y / r, -from.z / r, -1.0}, radius - r);
        }
        // place − centre = radius · normal; a float normal's ulp moves a place by the radius times as much
        double const weight = reach / (radius * size);
        for (std::size_t i = 0; normals && i < piece.places.size(); ++i) {
            dvec3 const n = outwards * piece.normals[i];
            dvec3 const off = weight * ((piece.places[i] - piece.centre) / size - c - radius * n);
            step.add({weight, 0.0, 0.0, weight * n.x}, off.x);
            step.add({0.0, weight, 0.0, weight * n.y}, off.y);
            step.add({0.0, 0.0, weight, weight * n.z}, off.z);
        }
        auto const by = step.solved();
        if (!by)
            return std::nullopt;
        c += dvec3((*by)[0], (*by)[1], (*by)[2]);
        radius += (*by)[3];
    }
    dvec3 const centre = piece.centre + size * c;
    radius *= size;
    if (!judge.accepts(
            piece, [&](dvec3 const& p) { return length(p - centre) - radius; },
            [&](dvec3 const& p) { return normalize(p - centre); }))
        return std::nullopt;
    if (dot(piece.normals.front(), piece.places.front() - centre) > 0.0)
        return Found{{Region::Kind::ball, centre, radius, 0.0}, {}, {}};
    dvec3 middle(0.0); // towards the centre, on the whole
    for (dvec3 const& n : piece.normals)
        middle += n;
    dvec3 const m = normalize(middle);
    return Found{{Region::Kind::quadric, centre, 0.0, 0.0},
                 outside_of_ball(radius),
                 Region{Region::Kind::half_space, m, dot(m, centre), 0.0}};
}

std::optional<Found> as_cylinder(Piece const& piece, Judge& judge) {
    if (piece.places.size() < 6)
        return std::nullopt;
    dmat3 scatter(0.0);
    for (dvec3 const& n : piece.normals)
        scatter += glm::outerProduct(n, n);
    dvec3 axis = least_direction(scatter);
    double size = 0.0;
    for (dvec3 const& p : piece.places)
        size = std::max(size, length(p - piece.centre));
    dvec3 x = perpendicular_to(axis), y = cross(axis, x), point(0.0); // lengths in `size`, from the centre
    double radius = 0.0;
    Equations<3> circle;
    for (dvec3 const& p : piece.places) {
        dvec3 const from = (p - piece.centre) / size;
        double const u = dot(from, x), v = dot(from, y);
        circle.add({2.0 * u, 2.0 * v, 1.0}, u * u + v * v);
    }
    if (auto const c = circle.solved()) {
        point = (*c)[0] * x + (*c)[1] * y;
        radius = std::sqrt(std::max((*c)[2] + dot(point, point), 0.0));
    }
    if (!(radius > 0.0) || !std::isfinite(radius) || radius > 1e3)
        return std::nullopt;
    for (int pass = 0; pass < 6; ++pass) { // shift and tilt of the axis, and the radius
        x = perpendicular_to(axis);
        y = cross(axis, x);
        Equations<5> step;
        for (dvec3 const& p : piece.places) {
            dvec3 const from = (p - piece.centre) / size - point;
            double const along = dot(from, axis);
            dvec3 const out = from - along * axis;
            double const r = length(out), nx = dot(out, x) / r, ny = dot(out, y) / r;
            step.add({-nx, -ny, -along * nx, -along * ny, -1.0}, radius - r);
        }
        auto const by = step.solved();
        if (!by)
            return std::nullopt;
        point += (*by)[0] * x + (*by)[1] * y;
        axis = normalize(axis + (*by)[2] * x + (*by)[3] * y);
        radius += (*by)[4];
    }
    dvec3 const on_axis = piece.centre + size * point;
    radius *= size;
    auto const out = [&](dvec3 const& p) { return (p - on_axis) - dot(p - on_axis, axis) * axis; };
    if (!judge.accepts(
            piece, [&](dvec3 const& p) { return length(out(p)) - radius; },
            [&](dvec3 const& p) { return normalize(out(p)); }))
        return std::nullopt;
    double const sign = dot(piece.normals.front(), out(piece.places.front())) > 0.0 ? 1.0 : -1.0;
    Quadric quadric;
    quadric.a = sign * (dmat3(1.0) - glm::outerProduct(axis, axis));
    quadric.c = -sign * radius * radius;
    return Found{{Region::Kind::quadric, on_axis, 0.0, 0.0}, quadric, {}};
}

void leave_out(Piece& piece, VertexShare share) {
    constexpr std::size_t few = 16;
    std::size_t const count = piece.places.size();
    if (share == VertexShare::all || count < 4)
        return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        bool const even = share == VertexShare::even;
        // by a hash: every other one may be all of one rim
        if (count < few ? i == (even ? 0 : count - 1) : (mix64(i) % 2 == 0) != even)
            continue;
        piece.places[kept] = piece.places[i];
        piece.normals[kept++] = piece.normals[i];
    }
    piece.places.resize(kept);
    piece.normals.resize(kept);
}

std::vector<Piece> pieces_of(SmoothFans const& fans, VertexShare share) {
    std::vector<Piece> pieces(fans.groups);
    std::vector<bool> seen(fans.fans.size(), false), has_face(fans.groups, false);
    for (std::uint32_t t = 0; t < fans.triangles.size(); ++t) {
        Piece& piece = pieces[fans.group[t]];
        std::uint32_t const face = fans.mesh->face_of(t);
        piece.one_face = piece.one_face && (!has_face[fans.group[t]] || piece.face == face);
        piece.face = face;
        has_face[fans.group[t]] = true;
        for (std::uint32_t const fan : fans.triangles[t].fans)
            if (!seen[fan]) {
                seen[fan] = true;
                piece.places.push_back(fans.fans[fan].place);
                piece.normals.push_back(fans.fans[fan].normal);
            }
    }
    for (Piece& piece : pieces) {
        leave_out(piece, share);
        for (dvec3 const& p : piece.places)
            piece.centre += p;
        piece.centre /= static_cast<double>(piece.places.size());
    }
    return pieces;
}

double height(Region const& region, dvec3 const& p) { // < 0 inside
    switch (region.kind) {
    case Region::Kind::half_space:
        return dot(region.a, p) - region.b;
    case Region::Kind::ball:
        return length(p - region.a) - region.b;
    default: {
        dvec3 const from = p - region.a;
        return region.quadric->value(from) / length(region.quadric->gradient(from));
    }
    }
}

/// How far a triangle may lie off what it stands for: less than that is no difference.
double sag_of(SmoothFans const& fans) {
    double most = 0.0;
    for (SmoothTriangle const& t : fans.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            Fan const &a = fans.fans[t.fans[k]], &b = fans.fans[t.fans[(k + 1) % 3]];
            most = std::max(most, length(a.place - b.place) * length(a.normal - b.normal));
        }
    return most;
}

/// Is the mesh's inside that of all regions together? At places drawn over its box.
bool same_body(SmoothFans const& fans, Solid const& solid) {
    constexpr int draws = 2000;
    Mesh const& mesh = *fans.mesh;
    Shadow const shadow = make_shadow(mesh.soup.positions, mesh.soup.triangles);
    dvec3 const size = mesh.high - mesh.low;
    double const sag = sag_of(fans);
    for (int i = 0; i < draws; ++i) {
        auto const draw = [&](std::uint32_t number) {
            return uniform(1, static_cast<std::uint64_t>(i), 0, number);
        };
        dvec3 const p = mesh.low - 0.05 * size + 1.1 * dvec3(draw(0), draw(1), draw(2)) * size;
        double most = -INFINITY;
        for (Region const& region : solid.regions())
            most = std::max(most, height(region, p));
        if (std::abs(most) > sag && (most < 0.0) != (winding_number(shadow, p) > 0))
            return false;
    }
    return true;
}

} // namespace

std::optional<RecognisedSolid> recognise(SmoothFans const& fans, VertexShare share) {
    Mesh const& mesh = *fans.mesh;
    if (!mesh.closed() || mesh.shells.size() != 1 || mesh.shells.front().sign < 0 || fans.groups == 0 ||
        fans.groups > most_regions)
        return std::nullopt;
    Judge judge{residual_ulps * fans.reach, fans.normals == NormalUse::files, fans.reach};
    std::vector<Region> regions, behind;
    std::vector<std::uint32_t> faces;
    std::vector<std::shared_ptr<Quadric const>> quadrics;
    for (Piece const& piece : pieces_of(fans, share)) {
        if (!piece.one_face || piece.places.size() < 3)
            return std::nullopt;
        std::optional<Found> found = as_plane(piece, judge);
        if (!found)
            found = as_sphere(piece, judge);
        if (!found)
            found = as_cylinder(piece, judge);
        if (!found)
            return std::nullopt;
        if (found->quadric) {
            quadrics.push_back(std::make_shared<Quadric const>(*found->quadric));
            found->region.quadric = quadrics.back().get();
        }
        regions.push_back(found->region);
        faces.push_back(piece.face);
        if (found->behind)
            behind.push_back(*found->behind);
    }
    for (Region const& region : behind) {
        regions.push_back(region);
        faces.push_back(0);
    }
    if (regions.size() > most_regions)
        return std::nullopt;
    for (Fan const& fan : fans.fans)
        for (Region const& region : regions)
            if (!(height(region, fan.place) <= 4.0 * judge.tolerance))
                return std::nullopt;
    double const sag = sag_of(fans);
    RecognisedSolid made{Solid(regions, std::move(quadrics), mesh.low - sag, mesh.high + sag),
                         std::move(faces), judge.residual, judge.normals_off};
    if (!same_body(fans, made.solid))
        return std::nullopt;
    return made;
}

} // namespace sahl

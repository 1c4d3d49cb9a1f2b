#include "geometry/patch_cell.h"

#include <algorithm>
#include <cmath>

namespace sahl {

PatchCell::PatchCell(std::array<dvec3, 3> const& corners, std::array<dvec3, 3> const& normals,
                     std::uint8_t creases, double noise) {
    corner = corners[0];
    dvec3 const e1 = corners[1] - corner, e2 = corners[2] - corner, across = cross(e1, e2);
    double const squared = dot(across, across);
    normal = across / std::sqrt(squared);
    to_v = cross(e2, across) / squared;
    to_w = cross(across, e1) / squared;
    double most = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        rise[k] = dot(normals[k], normal);
        lean[k] = {dot(to_v, normals[k]), dot(to_w, normals[k])};
        std::size_t const i = (k + 1) % 3, j = (k + 2) % 3;
        bulge[k] = (creases >> k & 1) ? 0.0 : 0.5 * dot(corners[j] - corners[i], normals[j] - normals[i]);
        most = std::max(most, std::abs(bulge[k]));
    }
    // the quadratic patch rises to a third of the greatest bulge; the rest is what another patch may differ
    // by
    double const up = std::max({bulge[0], bulge[1], bulge[2], 0.0});
    double const down = std::min({bulge[0], bulge[1], bulge[2], 0.0});
    high = 0.45 * up + 0.1 * most + noise;
    low = 0.45 * down - 0.1 * most - noise;
}

double CellPlace::least_weight() const {
    return std::min({1.0 - v - w, v, w});
}

CellPlace place_in(PatchCell const& cell, dvec3 const& point) {
    dvec3 const from = point - cell.corner;
    double const z = dot(cell.normal, from), v0 = dot(cell.to_v, from), w0 = dot(cell.to_w, from);
    CellPlace at{v0, w0, z};
    auto const& [la, lb, lc] = cell.lean;
    dvec2 const lb_a = lb - la, lc_a = lc - la;
    double last = INFINITY;
    for (int pass = 0; pass < 8; ++pass) {
        double const rise = (1.0 - at.v - at.w) * cell.rise[0] + at.v * cell.rise[1] + at.w * cell.rise[2];
        at.h = z / rise;
        // (v0, w0) = (v, w) + h (lean_a + v (lean_b − lean_a) + w (lean_c − lean_a))
        double const a = 1.0 + at.h * lb_a.x, b = at.h * lc_a.x, c = at.h * lb_a.y, d = 1.0 + at.h * lc_a.y;
        double const rv = v0 - at.h * la.x, rw = w0 - at.h * la.y, by = 1.0 / (a * d - b * c);
        double const v = (d * rv - b * rw) * by, w = (a * rw - c * rv) * by;
        double const change = std::abs(v - at.v) + std::abs(w - at.w);
        at.v = v;
        at.w = w;
        if (change < 1e-13 || !(change < last))
            break;
        last = change;
    }
    return at;
}

namespace {

/// What bends the surface onto the chord over a crease: it vanishes on the two other sides.
double chord_term(PatchSurface const& s, std::size_t k, std::array<double, 3> const& weight) {
    std::size_t const i = (k + 1) % 3, j = (k + 2) % 3;
    double const along = weight[j] + 0.5 * weight[k], rest = 1.0 - along;
    double const share = along * rest;
    if (!(share > 0.0))
        return 0.0;
    dvec3 const point = rest * s.corners[i] + along * s.corners[j];
    dvec3 ignored;
    double const off = rest * s.fields[i]->above(point, ignored) + along * s.fields[j]->above(point, ignored);
    return -weight[i] * weight[j] / share * off;
}

} // namespace

SurfaceValue PatchSurface::value(dvec3 const& point) const {
    SurfaceValue found;
    found.at = place_in(cell, point);
    std::array<double, 3> const weight = found.at.weights();
    std::array<double, 3> value{};
    double stand_in = 0.0; // weight of corners without a polynomial
    for (std::size_t k = 0; k < 3; ++k) {
        if (fields[k]) {
            dvec3 gradient;
            value[k] = fields[k]->above(point, gradient);
            found.normal += weight[k] * gradient;
        } else {
            value[k] = found.at.h - cell.model(found.at.v, found.at.w);
            found.normal += weight[k] * normals[k];
            stand_in += weight[k];
        }
        found.value += weight[k] * value[k];
    }
    found.gradient = found.normal;
    double by_v = value[1] - value[0], by_w = value[2] - value[0];
    if (stand_in != 0.0) {
        auto const [u, v, w] = weight;
        // the stand-in's gradient is that of h − model(v, w), not the corner's normal
        by_v -= stand_in * (w * cell.bulge[0] - w * cell.bulge[1] + (u - v) * cell.bulge[2]);
        by_w -= stand_in * (v * cell.bulge[0] + (u - w) * cell.bulge[1] - v * cell.bulge[2]);
        for (std::size_t k = 0; k < 3; ++k)
            if (!fields[k])
                found.gradient += weight[k] * (cell.normal / cell.rise[k] - normals[k]);
    }
    if (apart) {
        dvec3 all(0.0);
        for (std::size_t k = 0; k < 3; ++k) {
            dvec3 gradient = normals[k];
            if (fields[k])
                fields[k]->above(point, gradient);
            all += 0.5 * (1.0 - weight[k]) * gradient;
        }
        found.gradient += all - found.normal; // so that light keeps to the sides of what it meets
        found.normal = all;
    }
    if (creases && fields[0] && fields[1] && fields[2])
        for (std::size_t k = 0; k < 3; ++k)
            if (creases >> k & 1) {
                constexpr double step = 1e-6;
                auto const [u, v, w] = weight;
                double const here = chord_term(*this, k, weight);
                found.value += here;
                by_v += (chord_term(*this, k, {u - step, v + step, w}) - here) / step;
                by_w += (chord_term(*this, k, {u - step, v, w + step}) - here) / step;
            }
    found.gradient += by_v * cell.to_v + by_w * cell.to_w;
    return found;
}

std::optional<ModelRoot> model_root(PatchCell const& cell, dvec3 const& origin, dvec3 const& direction,
                                    bool rises) {
    double const squared = dot(direction, direction);
    ModelRoot root;
    root.base = dot(cell.corner - origin, direction) / squared;
    dvec3 const from = origin + root.base * direction - cell.corner;
    double const z = dot(cell.normal, from), dz = dot(cell.normal, direction);
    double const v = dot(cell.to_v, from), dv = dot(cell.to_v, direction);
    double const w = dot(cell.to_w, from), dw = dot(cell.to_w, direction);
    double const u = 1.0 - v - w, du = -dv - dw;
    auto const& [ba, bb, bc] = cell.bulge;
    // z − model along the line: a quadratic
    double const c = z - (v * w * ba + u * w * bb + u * v * bc);
    double const b = dz - ((v * dw + w * dv) * ba + (u * dw + w * du) * bb + (u * dv + v * du) * bc);
    double const a = -(dv * dw * ba + du * dw * bb + du * dv * bc);
    double const thickness = cell.high - cell.low;
    constexpr double margin = 0.15; // weight: leaning walls, and what the surface differs from the model by
    auto const near = [&](double t, double by) {
        return std::min({u + t * du, v + t * dv, w + t * dw}) >= -by;
    };
    root.bend = a;
    double discriminant = b * b - 4.0 * a * c;
    root.turn = a != 0.0 ? -0.5 * b / a : INFINITY;
    root.extreme = a != 0.0 ? c - 0.25 * b * b / a : INFINITY;
    // where the line runs along the surface, the model may have two roots where there are none, and the
    // reverse
    root.grazing = std::abs(root.extreme) < 0.3 * thickness && near(root.turn, 0.6);
    if (root.grazing)
        return root;
    if (discriminant < 0.0)
        return std::nullopt;
    double const s = std::sqrt(discriminant);
    if (rises)
        root.t = b >= 0.0 ? -2.0 * c / (b + s) : (s - b) / (2.0 * a);
    else
        root.t = b <= 0.0 ? 2.0 * c / (s - b) : (-b - s) / (2.0 * a);
    if (!std::isfinite(root.t) || !near(root.t, margin))
        return std::nullopt;
    return root;
}

namespace {

struct Walk {
    PatchSurface const& surface;
    dvec3 start, direction; // of t = base
    SurfaceValue here;
    double t = 0.0, slope = 0.0;

    void at(double where) {
        t = where;
        here = surface.value(start + t * direction);
        slope = dot(here.gradient, direction);
    }
};

/// Newton's method; where it has converged.
bool settle_on_root(Walk& walk, bool rises, double size, double bend) {
    double last = INFINITY;
    for (int pass = 0; pass < 12; ++pass) {
        double const step = -walk.here.value / walk.slope;
        if (!std::isfinite(step) || (walk.slope > 0.0) != rises)
            return false;
        double const off = std::abs(walk.here.value);
        if (off <= 4e-16 * size || (pass > 2 && off >= last && off <= 1e-12 * size))
            return true;
        last = off;
        // what Newton's step leaves is below rounding: the value there need not be seen
        if (off <= 1e-9 * size && std::abs(bend * step * step) <= 1e-17 * size) {
            walk.t += step;
            return true;
        }
        walk.at(walk.t + step);
    }
    return std::abs(walk.here.value) <= 1e-12 * size;
}

} // namespace

std::optional<PatchRoot> root_from(ModelRoot const& start, PatchSurface const& surface, dvec3 const& origin,
                                   dvec3 const& direction, bool rises, double slack) {
    Walk walk{surface, origin + start.base * direction, direction, {}, 0.0, 0.0};
    PatchCell const& cell = surface.cell;
    double const size = length(surface.corners[1] - surface.corners[0]) + length(walk.start) * 0.25;
    bool found = false;
    if (!start.grazing) {
        walk.at(start.t);
        found = settle_on_root(walk, rises, size, start.bend);
    }
    if (!found) {
        // from the place where the height over the surface is stationary: the root lies on its right or left
        if (start.bend == 0.0 || !std::isfinite(start.turn))
            return std::nullopt;
        walk.at(start.turn);
        for (int pass = 0; pass < 4; ++pass) {
            double const step = -0.5 * walk.slope / start.bend;
            walk.at(walk.t + step);
            if (std::abs(0.5 * step * walk.slope) <= 1e-17 * size)
                break;
        }
        double const square = -walk.here.value / start.bend;
        if (!(square >= 0.0))
            return std::nullopt;
        double const away = std::sqrt(square), turn = walk.t;
        for (double const share : {1.0, 1.05, 1.3, 2.0}) {
            walk.at(turn + ((start.bend > 0.0) == rises ? share : -share) * away);
            if ((found = settle_on_root(walk, rises, size, start.bend)))
                break;
        }
        if (!found)
            return std::nullopt;
    }
    double const margin = 0.5 * (cell.high - cell.low);
    if (walk.here.at.least_weight() < -slack || walk.here.at.h > cell.high + margin ||
        walk.here.at.h < cell.low - margin)
        return std::nullopt;
    return PatchRoot{start.base + walk.t, walk.start + walk.t * direction, walk.here};
}

} // namespace sahl

#include "geometry/patch_cell.h"

#include <algorithm>
#include <cmath>

namespace sahl {

double CellPlace::least_weight() const {
    return std::min({1.0 - v - w, v, w});
}

void PatchCell::locate(dvec3 const& point, CellPlace& place) const {
    dvec3 const first = patch_.direction(0), second = patch_.direction(1) - first,
                third = patch_.direction(2) - first;
    dvec3 const from = point - patch_.corner;
    double last = INFINITY;
    NetValue height;
    for (int pass = 0; pass < 8; ++pass) {
        dvec3 const by_v = patch_.to_second + place.h * second, by_w = patch_.to_third + place.h * third;
        dvec3 const up = first + place.v * second + place.w * third, across = cross(by_v, by_w);
        double const by = 1.0 / dot(across, up);
        dvec3 const off = from - place.v * patch_.to_second - place.w * patch_.to_third - place.h * up;
        dvec3 const to_v = by * cross(by_w, up), to_w = by * cross(up, by_v);
        double const dv = dot(to_v, off), dw = dot(to_w, off);
        place.v += dv;
        place.w += dw;
        place.h += by * dot(across, off);
        double const change = std::abs(dv) + std::abs(dw);
        if (change < 1e-13 || !(change < last)) {
            height = value_of(patch_.height, place.v, place.w);
            place.above = place.h - height.value;
            place.gradient = by * across - height.by_v * to_v - height.by_w * to_w;
            return;
        }
        last = change;
    }
    place.above = NAN; // outside of what the cell describes
}

namespace {

/// What the quadratic surface tells of a line: can it meet the surface in this cell at all? Quick, and yes in
/// doubt.
struct ModelRoot {
    double base = 0.0;    // t of the place that all is measured from
    double t = 0.0;       // from there: of the quadratic patch, of the sense asked for
    double turn = 0.0;    // from there: where the height over it is stationary
    double bend = 0.0;    // half of its second derivative
    double extreme = 0.0; // its value at `turn`
    bool grazing = false; // no root, or two that the model may have wrong
};

std::optional<ModelRoot> model_root(Patch const& patch, Relief const& relief, dvec3 const& origin,
                                    dvec3 const& direction, bool rises) {
    double const squared = dot(direction, direction);
    ModelRoot root;
    root.base = dot(patch.corner - origin, direction) / squared;
    dvec3 const from = origin + root.base * direction - patch.corner;
    dvec3 const across = cross(patch.to_second, patch.to_third);
    double const by_squared = 1.0 / dot(across, across);
    dvec3 const normal = across * std::sqrt(by_squared);
    dvec3 const to_v = cross(patch.to_third, across) * by_squared,
                to_w = cross(across, patch.to_second) * by_squared;
    double const z = dot(normal, from), dz = dot(normal, direction);
    double const v = dot(to_v, from), dv = dot(to_v, direction);
    double const w = dot(to_w, from), dw = dot(to_w, direction);
    double const u = 1.0 - v - w, du = -dv - dw;
    double const ba = relief.bulge_over(0), bb = relief.bulge_over(1), bc = relief.bulge_over(2);
    // z − model along the line: a quadratic
    double const c = z - (v * w * ba + u * w * bb + u * v * bc);
    double const b = dz - ((v * dw + w * dv) * ba + (u * dw + w * du) * bb + (u * dv + v * du) * bc);
    double const a = -(dv * dw * ba + du * dw * bb + du * dv * bc);
    double const thickness = static_cast<double>(relief.high) - static_cast<double>(relief.low);
    constexpr double margin = 0.15; // weight: leaning walls, and what the surface differs from the model by
    auto const near = [&](double t, double by) {
        return std::min({u + t * du, v + t * dv, w + t * dw}) >= -by;
    };
    root.bend = a;
    double const discriminant = b * b - 4.0 * a * c;
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

struct Walk {
    PatchCell const& cell;
    dvec3 start, direction; // of t = 0
    double size;            // m: what rounding is a share of
    CellPlace here{};
    double t = 0.0, slope = 0.0;

    void at(double where) {
        t = where;
        cell.locate(start + t * direction, here);
        slope = dot(here.gradient, direction);
    }

    /// Newton's method; where it has converged.
    bool settle(bool rises, double bend) {
        double last = INFINITY;
        for (int pass = 0; pass < 12; ++pass) {
            double const step = -here.above / slope;
            if (!std::isfinite(step) || (slope > 0.0) != rises)
                return false;
            double const off = std::abs(here.above);
            if (off <= 4e-16 * size || (pass > 2 && off >= last && off <= 1e-12 * size))
                return true;
            last = off;
            // what Newton's step leaves is below rounding: the value there need not be seen
            if (off <= 1e-9 * size && std::abs(bend * step * step) <= 1e-17 * size) {
                t += step;
                return true;
            }
            at(t + step);
        }
        return std::abs(here.above) <= 1e-12 * size;
    }
};

double size_of(Patch const& patch, dvec3 const& start) {
    return length(patch.to_second) + 0.25 * length(start);
}

} // namespace

bool PatchCell::holds(CellPlace const& place, double slack) const {
    auto const low = static_cast<double>(relief_.low), high = static_cast<double>(relief_.high);
    double const margin = 0.5 * (high - low);
    return place.least_weight() >= -slack && place.h <= high + margin && place.h >= low - margin;
}

std::optional<PatchCell::Root> PatchCell::root(dvec3 const& origin, dvec3 const& direction, bool rises,
                                               double slack) const {
    auto const model = model_root(patch_, relief_, origin, direction, rises);
    if (!model)
        return std::nullopt;
    dvec3 const start = origin + model->base * direction;
    Walk walk{*this, start, direction, size_of(patch_, start)};
    bool found = false;
    if (!model->grazing) {
        walk.at(model->t);
        found = walk.settle(rises, model->bend);
    }
    if (!found) {
        // from the place where the height over the surface is stationary: the root lies on its right or left
        if (model->bend == 0.0 || !std::isfinite(model->turn))
            return std::nullopt;
        walk.at(model->turn);
        for (int pass = 0; pass < 4; ++pass) {
            double const step = -0.5 * walk.slope / model->bend;
            walk.at(walk.t + step);
            if (std::abs(0.5 * step * walk.slope) <= 1e-17 * walk.size)
                break;
        }
        double const square = -walk.here.above / model->bend;
        if (!(square >= 0.0))
            return std::nullopt;
        double const away = std::sqrt(square), turn = walk.t;
        for (double const share : {1.0, 1.05, 1.3, 2.0}) {
            walk.at(turn + ((model->bend > 0.0) == rises ? share : -share) * away);
            if ((found = walk.settle(rises, model->bend)))
                break;
        }
    }
    if (!found || !holds(walk.here, slack))
        return std::nullopt;
    return Root{model->base + walk.t, walk.here};
}

} // namespace sahl

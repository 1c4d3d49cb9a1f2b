// In: a triangle with a normal at each corner, and what surface runs through the corners. Out: where a line
// meets that surface within the triangle's cell. The cell is what triangles x = Σ w_k (p_k + h n_k) of all
// heights h fill; two that share an edge share its wall. So a surface that is given by the same function on
// both sides of each wall has neither gap nor overlap, and its crossings alternate like those of the
// triangles.
#pragma once

#include "geometry/patch_fit.h"
#include "math/inline_vector.h"

#include <array>
#include <cstdint>
#include <optional>

namespace sahl {

struct PatchCell {
    dvec3 corner{0.0}, normal{0.0}; // of the triangle's plane; unit
    dvec3 to_v{0.0}, to_w{0.0};     // gradients of the second and third corner's weights in the plane
    std::array<dvec2, 3> lean{};    // of each corner's normal, in those weights per m of height
    std::array<double, 3> rise{};   // n_k · normal
    std::array<double, 3> bulge{};  // m: the surface's height over the side opposite corner k is 4 u(1−u)
                                    // of this at the middle: bulge = 4 × height there
    double low = 0.0, high = 0.0;   // m: between these heights lies the surface

    PatchCell(std::array<dvec3, 3> const& corners, std::array<dvec3, 3> const& normals, std::uint8_t creases,
              double noise);

    /// Height over the plane by the quadratic patch, and its change with the second and third weight.
    double model(double v, double w) const {
        double const u = 1.0 - v - w;
        return v * w * bulge[0] + u * w * bulge[1] + u * v * bulge[2];
    }
};

/// A place in a cell: weights of the second and third corner, and height.
struct CellPlace {
    double v = 0.0, w = 0.0, h = 0.0;
    std::array<double, 3> weights() const { return {1.0 - v - w, v, w}; }
    double least_weight() const;
};

CellPlace place_in(PatchCell const& cell, dvec3 const& point);

/// The surface function's corners: a polynomial, or none, where the quadratic patch stands in.
using CellFields = std::array<HeightField const*, 3>;

/// > 0 outside; its gradient in space, and the normal for light: that of the polynomials, weighted.
struct SurfaceValue {
    double value = 0.0;
    dvec3 gradient{0.0}, normal{0.0};
    CellPlace at;
};

struct PatchSurface {
    PatchCell const& cell;
    std::array<dvec3, 3> corners, normals;
    CellFields fields;
    std::uint8_t creases;
    bool apart = false; // the light's normal is that of the farther corners' polynomials

    SurfaceValue value(dvec3 const& point) const;
};

/// Where a line meets the surface in a cell, going out of the body (rises) or into it.
struct PatchRoot {
    double t = 0.0;
    dvec3 point{0.0};
    SurfaceValue surface;
};

/// The root of that sense, or nothing.
///   slack   how far outside the cell it may lie, as a weight
std::optional<PatchRoot> root_in(PatchSurface const& surface, dvec3 const& origin, dvec3 const& direction,
                                 bool rises, double slack);

/// Can the line meet the surface in this cell at all? Quick, and yes in doubt.
struct ModelRoot {
    double base = 0.0;    // t of the place that all is measured from
    double t = 0.0;       // from there: of the quadratic patch, of the sense asked for
    double turn = 0.0;    // from there: where the height over it is stationary
    double bend = 0.0;    // half of its second derivative
    double extreme = 0.0; // its value at `turn`
    bool grazing = false; // no root, or two that the model may have wrong
};
std::optional<ModelRoot> model_root(PatchCell const& cell, dvec3 const& origin, dvec3 const& direction,
                                    bool rises);

/// As root_in, from a model root that is known.
std::optional<PatchRoot> root_from(ModelRoot const& start, PatchSurface const& surface, dvec3 const& origin,
                                   dvec3 const& direction, bool rises, double slack);

} // namespace sahl

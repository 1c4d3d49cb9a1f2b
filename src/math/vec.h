// In: nothing. Out: the vectors, matrices and affine maps that all rooms share.
// The only door to GLM; everything is double, right-handed, column vectors.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sahl {

using glm::cross;
using glm::dmat3;
using glm::dot;
using glm::dvec2;
using glm::dvec3;
using glm::length;
using glm::normalize;
using glm::vec2; // single precision, for what a file has in it and no light depends on

/// x ↦ linear · x + offset. Lengths in metres.
struct Affine {
    dmat3 linear{1.0};
    dvec3 offset{0.0};

    dvec3 point(dvec3 const& p) const { return linear * p + offset; }
    dvec3 vector(dvec3 const& v) const { return linear * v; }
    bool operator==(Affine const&) const = default;
};

/// outer ∘ inner: inner is applied first.
inline Affine compose(Affine const& outer, Affine const& inner) {
    return {outer.linear * inner.linear, outer.linear * inner.offset + outer.offset};
}

/// The map back; the linear part must not be singular.
inline Affine inverse(Affine const& map) {
    dmat3 const back = glm::inverse(map.linear);
    return {back, -(back * map.offset)};
}

/// The unit vector along one whose length is 1 but for rounding: one step of Newton's method, which needs
/// neither root nor division and leaves an error of ⅜ε² where the squared length is 1 + ε.
inline dvec3 unit_again(dvec3 const& v) {
    return (1.5 - 0.5 * dot(v, v)) * v;
}

/// A unit vector at right angles to the unit vector `axis`: along `up` made orthogonal where that is
/// possible, otherwise along the coordinate axis that is least parallel to it.
inline dvec3 perpendicular_to(dvec3 const& axis, dvec3 const& up = dvec3(0.0)) {
    dvec3 side = up - dot(up, axis) * axis;
    if (dot(side, side) <= 1e-24 * dot(up, up)) { // parallel to within what a direction's rounding can tell
        dvec3 const a = glm::abs(axis);
        dvec3 const e = a.x <= a.y && a.x <= a.z ? dvec3(1, 0, 0)
                        : a.y <= a.z             ? dvec3(0, 1, 0)
                                                 : dvec3(0, 0, 1);
        side = e - dot(e, axis) * axis;
    }
    side = normalize(side);
    return normalize(side - dot(side, axis) * axis); // again: little may have been left of `up`
}

} // namespace sahl

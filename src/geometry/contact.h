// In: faces of exact shapes and where they stand. Out: which of them lie on the same surface.
// Contact is a fact of the scene, found once: only crossings of such faces are merged, so that a real gap,
// however small, stays a gap.
#pragma once

#include "geometry/quadric.h"
#include "geometry/revolved.h"
#include "geometry/shape.h"
#include "geometry/solid.h"

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

namespace sahl {

/// What a face is part of, in the frame of its shape.
struct PlaneCarrier {
    dvec3 normal; // unit
    double offset;
};
struct SphereCarrier {
    dvec3 centre;
    double radius;
};
struct TubeCarrier {
    dvec3 point, axis; // unit axis
    double radius;
};
struct RevolvedCarrier {
    dvec3 vertex, axis; // unit axis
    Revolved form;
};
struct QuadricCarrier { // a cone's side, a general quadric: all of it, an apex and a second sheet too
    Quadric form;
};
using Carrier = std::variant<PlaneCarrier, SphereCarrier, TubeCarrier, RevolvedCarrier, QuadricCarrier>;
/// A quadric's caps are one face of six planes; any other face has one carrier.
using Carriers = std::vector<Carrier>;

Carriers carriers_of(Region const& region);
Carrier carrier_of(RevolvedSheet const& sheet, dvec3 const& vertex);
Carrier sheet_carrier(); // z = 0

/// Do two carriers, each seen through the map to the world of its shape, coincide to within the rounding of
/// the coordinates that they were made from?
///   reach    m, in the frame of the first: how far from its origin the face extends
bool coincide(Carrier const& one, Affine const& one_to_world, Carrier const& other,
              Affine const& other_to_world, double reach);

/// Where two carriers touch at one point: a ball and a plane, two balls. To the same rounding, in the world.
std::optional<dvec3> tangent_point(Carrier const& one, Affine const& one_to_world, Carrier const& other,
                                   Affine const& other_to_world, double reach);

/// The rounding of the coordinates that two objects were placed by, m, in the frame of the first, `reach`
/// from whose origin they meet.
double placing_tolerance(Affine const& one_to_world, Affine const& other_to_world, double reach);

/// A carrier seen through an affine map; nothing where it is not of the same kind any more (a sphere that is
/// stretched).
std::optional<Carrier> seen_through(Carrier const& carrier, Affine const& map);

} // namespace sahl

// In: a ray that comes through one place of the film. Out: how its neighbours run beside it, through mirrors
// and glass: what a picture on a surface has to be averaged over.
// Source: H. Igehy, "Tracing ray differentials", SIGGRAPH (1999), sections 3 and 4.
#pragma once

#include "math/vec.h"

namespace sahl {

/// Derivatives of a ray by one coordinate of the film.
struct RayDifferential {
    dvec3 place{0.0}, heading{0.0}; // of its start (m) and of its unit direction, for one step on the film

    /// On to a surface, on which its place then moves.
    ///   t   m; normal   of the surface there, either way round
    void go(double t, dvec3 const& direction, dvec3 const& normal);
    /// normal, turn   facing the ray: dot(normal, direction) < 0; how the normal changes for the step, made
    ///                of the surface's curvature
    void reflect(dvec3 const& direction, dvec3 const& normal, dvec3 const& turn);
    /// refracted   the direction after it, unit
    void refract(dvec3 const& direction, dvec3 const& refracted, dvec3 const& normal, dvec3 const& turn,
                 double n_incident, double n_transmitted);
};

/// For a step to the right and a step down.
struct Footprint {
    RayDifferential across, down;
};

} // namespace sahl

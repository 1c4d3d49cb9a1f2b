// In: a scene with meshes that are not closed, and the rays that were lost. Out: which hole each went
// through.
#pragma once

#include "trace/tracer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sahl {

/// A border of a mesh that is traced as a body: the edge of a hole.
struct Hole {
    ObjectId body;
    dvec3 centre{0.0};   // m, world
    double radius = 0.0; // m, world: of a circle as long as the border
    std::uint64_t edges = 0;
    std::uint64_t leaks = 0; // rays that leaked, nearest to this one
};

/// The longest borders of each mesh; empty where all are closed.
std::vector<Hole> holes_of(Scene const& scene);

/// Counts a leak for the hole whose centre the ray passes nearest to, in multiples of its radius, on the line
/// of its last piece, to either side: it shows either where the ray came in or where it was to go out.
void count_leak(std::vector<Hole>& holes, LostRay const& ray);

/// One for each mesh that is traced as a body and is not closed, before any ray is.
std::vector<std::string> unclosed_warnings(Scene const& scene);

/// "torn: 12 rays leaked at the hole of 3 edges round (…) mm", for each that any ray found.
std::vector<std::string> hole_warnings(Scene const& scene, std::vector<Hole> const& holes);

} // namespace sahl

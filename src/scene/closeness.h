// In: a scene. Out: in words, which faces touch, which bodies overlap, and what nearly touches.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace sahl {

/// "lens.back touches plate.front", one for each pair of faces; and which meshes were made flush with what
/// they touch.
std::vector<std::string> contact_lines(Scene const& scene);

/// Bodies of other media that overlap at equal priority, with a place: the later one is there.
std::vector<std::string> overlap_warnings(Scene const& scene);

/// Curved faces of meshes that follow a face of another body without lying on it; and gaps thinner than
/// `wavelength` (m) between faces that do not touch: light would pass them in part, which rays do not.
std::vector<std::string> near_warnings(Scene const& scene, double wavelength);

} // namespace sahl

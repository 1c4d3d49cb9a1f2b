// In: the tables [[source]] and [[detector]]. Out: where light comes from and where it is counted, in the
// world.
#pragma once

#include "scene/experiment.h"
#include "scene/read_transform.h"

#include <filesystem>
#include <vector>

namespace sahl {

/// folder   that of the experiment's file
/// Throws InputError. Names are not compared with one another here.
std::vector<SourceSpec> read_sources(Array const& tables, Groups const& groups,
                                     std::filesystem::path const& folder);

std::vector<DetectorSpec> read_detectors(Array const& tables, Groups const& groups);

/// The wavelengths (m) of a source with their weights, from wavelengths_nm or lines, and weights; 587.5618 nm
/// without.
std::vector<std::pair<double, double>> read_wavelengths(Fields const& source);

/// Single rays under the key `rays` or `file`, in the world, and the sum of their powers where they have
/// some, else 0.
struct RayList {
    std::vector<RaySpec> rays;
    double power = 0.0;
};
RayList read_ray_list(Value const& list, Affine const& to_world);
RayList read_ray_file(std::filesystem::path const& path, Affine const& to_world);

} // namespace sahl

// In: what a log says of its experiment. Out: where its flat detectors face, which its rows do not say.
#pragma once

#include "math/vec.h"
#include "record/ray_log.h"

#include <map>
#include <string>

namespace sahl {

/// Of each flat detector the unit vector along which it faces, by name; fewer, or none, where the
/// experiment's text does not say it alone, as where it needs files beside it.
std::map<std::string, dvec3> detector_normals(LogHeader const& header);

} // namespace sahl

// In: the table `shape` of an object. Out: an exact shape in metres.
#pragma once

#include "geometry/shape.h"
#include "scene/value.h"

namespace sahl {

/// Throws InputError: no shape or several, an unknown one, one that this version does not trace, impossible
/// sizes.
Shape read_shape(Value const& table);

} // namespace sahl

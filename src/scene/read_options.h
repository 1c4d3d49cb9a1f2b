// In: the tables [trace], [log], [limits] and [sweep]. Out: how to trace, what to write, what counts as
// failed.
#pragma once

#include "scene/experiment.h"

#include <vector>

namespace sahl {

/// Each takes the whole tree; a table that is absent has its defaults. They throw InputError.
TraceOptions read_trace(Value const& tree);
LogOptions read_log(Value const& tree);
Limits read_limits(Value const& tree);

/// The axes of the sweep, at most one. Whether the key exists is checked by read_experiment.
std::vector<SweepAxis> read_sweep(Value const& tree);

/// Looks at camera, lights and background, which have no part in tracing.
void check_picture_keys(Value const& tree);

} // namespace sahl

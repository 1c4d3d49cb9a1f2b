// In: the tables [trace], [log] and [limits]. Out: how to trace, what to write, what counts as failed.
#pragma once

#include "scene/experiment.h"

namespace sahl {

/// Each takes the whole tree; a table that is absent has its defaults. They throw InputError.
TraceOptions read_trace(Value const& tree);
LogOptions read_log(Value const& tree);
Limits read_limits(Value const& tree);

} // namespace sahl

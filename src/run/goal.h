// In: an experiment with a goal. Out: the run that comes up to it, and a table of all that were made.
#pragma once

#include "run/run.h"

namespace sahl {

/// Traces `looks` runs side by side, then one after another by Brent's methods between the neighbours of the
/// best (or where the figure passes the value), and at last writes the run that was found: its folder is that
/// of an ordinary run, with `goal` in summary.json, and goal.csv. Throws InputError where no summary has the
/// figure, or the goal is not come to.
RunResult run_goal(ExperimentSource const& source, Experiment const& experiment, RunOptions const& options,
                   std::filesystem::path const& folder);

} // namespace sahl

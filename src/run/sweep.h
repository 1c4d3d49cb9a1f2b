// In: an experiment with a sweep. Out: a run for each of its steps, a table of them all, and a page.
#pragma once

#include "run/run.h"

namespace sahl {

/// Writes runs/000, runs/001, … each in one step, so that a folder of this name is complete; then sweep.csv,
/// summary.json and report.html. Runs that stand there already are kept. Steps run side by side, but one
/// after another where each writes a log. Throws InputError.
RunResult run_sweep(ExperimentSource const& source, Experiment const& experiment, RunOptions const& options,
                    std::filesystem::path const& folder);

/// The page of a sweep that is complete in `folder`, written anew.
///   summary   the folder's summary.json
void write_sweep_page(ExperimentSource const& source, std::filesystem::path const& folder,
                      Value const& summary);

/// Equal for two starts that make the same runs: program, experiment, settings, and the bytes of every file
/// that the experiment names. Of what a model names in its turn, buffers and materials beside it, size and
/// time of writing.
std::string sweep_identity(ExperimentSource const& source);

} // namespace sahl

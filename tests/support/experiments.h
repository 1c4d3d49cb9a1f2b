// In: the name of an experiment that stands in experiments/, and what to set in it. Out: what `sahl trace`
// makes of it.
#pragma once

#include "support/bench.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sahl::bench {

/// Of experiments/NAME/NAME.toml.
std::filesystem::path experiment_file(std::string const& name);

/// Runs it into the folder `out`; that no check of physics fails is checked.
RunResult run_experiment_of(std::string const& name, std::filesystem::path const& out,
                            std::vector<std::string> const& set);

/// The same with trace.log on, and the log read back. Nothing stays on disk.
Run run_of(std::string const& name, std::vector<std::string> set);

/// A file's columns by name; what is no number is NaN.
std::map<std::string, std::vector<double>> read_sweep(std::filesystem::path const& csv);

/// The bunny's file if models/fetch_bunny.py has brought it, else nothing, with a word.
bool has_bunny();

} // namespace sahl::bench

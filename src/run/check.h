// In: an experiment or a model. Out: what is in it, whether it is fit to trace, and what would go wrong.
#pragma once

#include "run/run.h"

#include <filesystem>

namespace sahl {

/// Reads and builds everything, sends a few pilot rays through it, and writes nothing. Throws InputError.
/// The keys are listed in docs/check.md.
Value check_experiment(ExperimentSource const& source);

/// The same for a model file alone, as an experiment would have it that says no more than the file does; one
/// in a format without a unit is taken to be in millimetres.
Value check_model(std::filesystem::path const& file);

/// As text for a person: a verdict, then the parts.
std::string check_text(Value const& report);

} // namespace sahl

// In: an experiment or a model. Out: what is in it, whether it is fit to trace, and what would go wrong.
#pragma once

#include "run/run.h"

#include <filesystem>

namespace sahl {

/// Reads and builds everything, sends a few pilot rays through it, and writes nothing. Throws InputError.
/// The result has `title, objects, media, contacts, sources, detectors, models, warnings`.
Value check_experiment(ExperimentSource const& source);

/// The same for a model file alone: `instances, materials, models, warnings`.
Value check_model(std::filesystem::path const& file);

/// As text for a person.
std::string check_text(Value const& report);

} // namespace sahl

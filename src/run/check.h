// In: an experiment or a model. Out: what is in it, whether it is fit to trace, and what would go wrong.
#pragma once

#include "run/run.h"

#include <filesystem>

namespace sahl {

/// Reads and builds everything, sends a few pilot rays through it, and writes nothing. Throws InputError.
/// The keys are listed in docs/check.md.
///   fit   tells too what fineness each mesh carries, by each source's pilots (run/mesh_fit.h)
Value check_experiment(ExperimentSource const& source, bool fit = false);

/// The same for a model file alone, as an experiment would have it that says no more than the file does; one
/// in a format without a unit is taken to be in millimetres.
///   fit   a tolerance of directions, rad: tells too what fineness each mesh carries, by light along x, y, z
///         that goes in and out of it
Value check_model(std::filesystem::path const& file, std::optional<double> fit = std::nullopt);

/// A model as check_model looks at it.
struct CheckedModel {
    Scene scene;
    Value report;
};
CheckedModel look_at_model(std::filesystem::path const& file);

/// As text for a person: a verdict, then the parts.
std::string check_text(Value const& report);

} // namespace sahl

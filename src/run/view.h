// In: the folder of a finished run, or a model. Out: report.html, and where it stands.
#pragma once

#include "run/run.h"

#include <filesystem>
#include <optional>

namespace sahl {

/// Writes the page of a finished run anew, in the form of this program: with the data of the page that is
/// there, or, with the experiment it was made of, with rays traced again and what the run's files say. Where
/// a chart.json of `sahl chart` stands in the folder, its chart is on the page. Throws InputError.
std::filesystem::path view_run(std::filesystem::path const& folder,
                               std::optional<std::filesystem::path> const& experiment);

/// A page with a model and the report of its check, what is wrong drawn in place. Throws InputError.
std::filesystem::path view_model(std::filesystem::path const& model, std::filesystem::path const& out);

} // namespace sahl

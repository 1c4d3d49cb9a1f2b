// In: an experiment at one point of what it may vary over. Out: its results in a folder, and its summary.
#pragma once

#include "report/page.h"
#include "run/run.h"

namespace sahl {

struct OneRun {
    Scene scene;
    Value summary;
    std::vector<std::string> failures;
    std::vector<std::string> pictures; // relative to the folder
    std::vector<Segment> paths;
    std::uint64_t rays_shown = 0;
};

/// Traces it and writes all but the page. An empty folder: nothing is written, and there are no paths.
OneRun run_once(ExperimentSource const& source, Experiment const& experiment, RunOptions const& options,
                std::filesystem::path const& folder);

/// What run_once returned for a run that stands in `folder` already, without tracing all of it again.
OneRun drawn_again(Experiment const& experiment, Value summary, std::filesystem::path const& folder,
                   ModelCache* models);

/// report.html, of a run, or with keys and rows of a sweep; nothing where the folder is empty.
void write_page(std::filesystem::path const& folder, OneRun const& run, Value const& summary,
                std::vector<std::string> const& keys, std::vector<SweepRow> const& rows);

/// Throws InputError where the file cannot be written.
void write_text(std::filesystem::path const& file, std::string const& text);

} // namespace sahl

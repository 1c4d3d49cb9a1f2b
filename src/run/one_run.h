// In: an experiment at one point of what it may vary over. Out: its results in a folder, and its summary.
#pragma once

#include "report/page.h"
#include "run/run.h"

namespace sahl {

struct OneRun {
    Scene scene;
    Value summary;
    std::vector<std::string> failures;
    LogHeader names; // of what the paths meet
    PagePaths paths;
    std::vector<PageDetector> detectors;
};

/// Traces it and writes all but the page. An empty folder: nothing is written, and there are no paths.
///   segments   of its paths, for the page: at most so many
OneRun run_once(ExperimentSource const& source, Experiment const& experiment, RunOptions const& options,
                std::filesystem::path const& folder, std::size_t segments = most_page_segments);

/// What run_once returned for a run that stands in `folder` already, without tracing all of it again.
OneRun drawn_again(ExperimentSource const& source, Experiment const& experiment, Value summary,
                   std::filesystem::path const& folder, ModelCache* models);

/// report.html, of a run, or with keys and rows of a sweep; nothing where the folder is empty.
///   segments   that are drawn at most
void write_page(std::filesystem::path const& folder, OneRun const& run, Value const& summary,
                std::vector<std::string> const& keys, std::vector<SweepRow> const& rows,
                std::size_t segments = most_page_segments);

/// Throws InputError where the file cannot be written.
void write_text(std::filesystem::path const& file, std::string const& text);

} // namespace sahl

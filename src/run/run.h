// In: an experiment file. Out: its results in a folder, and what they amount to.
#pragma once

#include "run/trace_scene.h"
#include "scene/read_experiment.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sahl {

class ModelCache;

/// An experiment file as read, with what was set on top of it.
struct ExperimentSource {
    std::filesystem::path file;
    std::string text;             // as read
    Value tree;                   // with `set` applied
    std::vector<std::string> set; // KEY=VALUE, in the order given
};

/// Reads a file and applies KEY=VALUE settings. Throws InputError.
ExperimentSource load_experiment(std::filesystem::path const& file, std::vector<std::string> const& set = {});

struct RunOptions {
    std::filesystem::path out; // empty: nothing is written
    unsigned threads = 0;      // 0: all there are
    std::optional<std::filesystem::path>
        log_file;        // instead of rays.h5 in the folder; its presence turns the log on
    bool resume = false; // a run of the same experiment that was stopped goes on, if there is one
    std::optional<double> keep_every_s = 10.0; // how often what is known so far is kept for that, where there
                                               // is no log; none: never
    Progress progress;                         // of each run
    std::function<void(std::size_t step, std::size_t steps)> sweep_progress;
    std::atomic<bool> const* stop = nullptr; // once it is set, the run ends as soon as it can, by RunStopped
    ModelCache* models = nullptr;            // those of earlier runs; none: each run reads its own
};

/// Thrown where a run was stopped: no results are written.
struct RunStopped {
    std::filesystem::path kept; // where what is known stays, for `resume` to go on from; empty: nowhere
};

struct RunResult {
    Value summary;                     // as in summary.json
    std::vector<std::string> failures; // of the checks of physics; empty: all passed
};

/// Traces the experiment, or each step of its sweep, and writes summary.json, rays.h5 if asked for,
/// detectors/, sweep.csv and report.html. Throws InputError, and then nothing is written; and RunStopped.
RunResult run_experiment(ExperimentSource const& source, RunOptions const& options);

/// Of the file as read; where it names catalogues of glasses, of that and what stands in them.
std::string experiment_sha256(ExperimentSource const& source);

/// What to say of an experiment that asks for fewer triangles where all are kept; nothing where it does not.
std::optional<std::string> keeps_all_triangles(Experiment const& experiment);

/// "sahl 0.1.0".
std::string program_name();

} // namespace sahl

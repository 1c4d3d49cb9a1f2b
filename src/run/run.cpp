#include "run/run.h"

#include "math/input_error.h"
#include "run/goal.h"
#include "run/one_run.h"
#include "run/run_folder.h"
#include "run/sha256.h"
#include "run/sweep.h"
#include "scene/read_file.h"
#include "scene/read_model.h"

#include <algorithm>

namespace sahl {

namespace fs = std::filesystem;

std::string program_name() {
    return "sahl " SAHL_VERSION;
}

std::string experiment_sha256(ExperimentSource const& source) {
    std::string all = source.text;
    if (Value const* const catalogues = source.tree.find("catalogues"))
        for (Value const& item : std::get<Array>(catalogues->data))
            all += "\n" + sha256(file_text(source.file.parent_path() / std::get<std::string>(item.data)));
    return sha256(all);
}

ExperimentSource load_experiment(fs::path const& file, std::vector<std::string> const& set) {
    if (is_model_file(file))
        throw InputError(file.string(), "this is a model, and no experiment",
                         "name it in one, as model = \"…\" of an [[object]]; sahl check says what is in it");
    ExperimentSource source;
    source.file = file;
    source.tree = read_experiment_file(file, source.text);
    source.set = set;
    for (std::string const& assignment : set)
        set_key_from_text(source.tree, assignment);
    return source;
}

std::optional<std::string> keeps_all_triangles(Experiment const& experiment) {
    bool const asked =
        std::any_of(experiment.objects.begin(), experiment.objects.end(), [](auto const& object) {
            auto const* const model = std::get_if<ModelReference>(&object.what);
            return model && model->decimate > 0.0;
        });
    if (!asked && !experiment.trace.decimate)
        return {};
    return "decimate and decimate_mm are for `sahl trace`: here meshes have all of their triangles";
}

namespace {

RunResult results_of(ExperimentSource const& source, Experiment const& experiment, RunOptions const& options,
                     fs::path const& work) {
    if (!experiment.sweep.empty())
        return run_sweep(source, experiment, options, work);
    if (experiment.goal)
        return run_goal(source, experiment, options, work);
    OneRun run = run_once(source, experiment, options, work);
    write_page(work, run, run.summary, {}, {});
    return {std::move(run.summary), std::move(run.failures)};
}

} // namespace

RunResult run_experiment(ExperimentSource const& source, RunOptions const& options) {
    Experiment const experiment =
        read_experiment(source.tree, source.file); // all errors of input, before a file is made
    need_sources(experiment);
    bool const sweeps = !experiment.sweep.empty();
    std::optional<RunFolder> folder;
    if (!options.out.empty() && sweeps)
        folder.emplace(options.out, sweep_identity(source));
    else if (!options.out.empty())
        folder.emplace(options.out, sweep_identity(source),
                       options.resume ? Unfinished::same_goes_on : Unfinished::removed);
    fs::path const work = folder ? folder->path() : fs::path();
    RunResult result;
    try {
        result = results_of(source, experiment, options, work);
    } catch (RunStopped const&) {
        throw RunStopped{folder && folder->keep() ? work : fs::path()};
    }
    if (folder)
        folder->publish();
    return result;
}

} // namespace sahl

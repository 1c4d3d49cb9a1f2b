#include "run/sweep.h"

#include "math/input_error.h"
#include "run/one_run.h"
#include "run/sha256.h"
#include "run/side_by_side.h"
#include "run/sweep_table.h"
#include "run/values.h"
#include "scene/model_cache.h"
#include "scene/read_file.h"
#include "scene/read_sweep.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <mutex>
#include <system_error>

namespace sahl {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t segments_on_step_page = 2000; // a sweep may have a thousand such pages

struct Step {
    ExperimentSource source;
    std::string words; // "object.lens.move_mm[2] = 3.5"
};

Step step_of(ExperimentSource const& source, SweepSpec const& sweep, std::size_t run) {
    auto const values = sweep.point(run);
    Step step{source, {}};
    step.source.tree = tree_at(source.tree, sweep.axes, values);
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::string const value = to_json(values[i]);
        step.source.set.push_back(sweep.axes[i].key + "=" + value);
        step.words += (i == 0 ? "" : ", ") + sweep.axes[i].key + " = " + value;
    }
    return step;
}

/// What a complete run from an earlier start has to say, if it is there.
std::optional<Value> kept_summary(fs::path const& folder) {
    std::ifstream in(folder / "summary.json", std::ios::binary);
    if (!in)
        return {};
    std::string const text{std::istreambuf_iterator<char>(in), {}};
    return parse_json(text, (folder / "summary.json").string());
}

struct Steps {
    ExperimentSource const& source;
    Experiment const& experiment;
    RunOptions const& options;
    fs::path const& folder;
    std::vector<SweepRow> rows;
    std::vector<std::vector<std::string>> failures;
    std::vector<char> kept;
    OneRun first;

    /// Into a folder of its own, which gets its name when all of it is there.
    ///   segments   of its paths that are kept, at most
    OneRun run(Step const& step, fs::path const& place, RunOptions const& how, std::size_t segments) const {
        Experiment const read = read_experiment(step.source.tree, step.source.file);
        if (folder.empty())
            return run_once(step.source, read, how, {});
        fs::path work = place;
        work += ".part";
        fs::remove_all(work);
        fs::create_directories(work);
        OneRun run = run_once(step.source, read, how, work, segments);
        write_page(work, run, run.summary, {}, {}, segments_on_step_page);
        fs::rename(work, place);
        return run;
    }

    void take(std::size_t i, RunOptions const& how) {
        Step const step = step_of(source, experiment.sweep, i);
        fs::path const place = folder.empty() ? folder : folder / "runs" / run_name(i);
        OneRun run;
        if (auto summary = folder.empty() ? std::nullopt : kept_summary(place)) {
            kept[i] = 1;
            if (i == 0)
                run = drawn_again(step.source, read_experiment(step.source.tree, step.source.file), *summary,
                                  place, how.models);
            for (Value const& failure : std::get<Array>(summary->find("failures")->data))
                failures[i].push_back(step.words + ": " + std::get<std::string>(failure.data));
            run.summary = std::move(*summary);
        } else {
            run = this->run(step, place, how, i == 0 ? most_page_segments : segments_on_step_page);
            for (std::string const& failure : run.failures)
                failures[i].push_back(step.words + ": " + failure);
        }
        rows[i] = {experiment.sweep.point(i), run.summary};
        if (i == 0)
            first = std::move(run);
    }
};

void run_all(Steps& steps, std::size_t runs) {
    RunOptions how = steps.options;
    ModelCache models; // a step that changes nothing of a model does not read it again
    how.models = &models;
    how.threads = threads_of(how.threads);
    how.keep_every_s.reset(); // each run is kept when it is done
    // HDF5 writes one log at a time, and the rays of a run that has a log fill the threads
    bool const apart = steps.experiment.log.on && !steps.folder.empty();
    std::mutex mutex;
    std::size_t done = 0;
    auto const take = [&](std::size_t i) {
        steps.take(i, how);
        std::scoped_lock const lock(mutex);
        if (steps.options.sweep_progress)
            steps.options.sweep_progress(++done, runs);
    };
    if (apart || how.threads == 1)
        for (std::size_t i = 0; i < runs; ++i)
            take(i);
    else {
        how.progress = {}; // of many runs at once it would say nothing
        side_by_side(runs, how.threads, take);
    }
}

} // namespace

RunResult run_sweep(ExperimentSource const& source, Experiment const& experiment, RunOptions const& options,
                    fs::path const& folder) {
    SweepSpec const& sweep = experiment.sweep;
    if (options.log_file)
        throw InputError(
            sweep.axes.front().place.text(), "a sweep makes a run, and a log, for each value",
            "leave --log FILE away and set trace.log = true: each run's log stands in its own folder");
    auto const start = std::chrono::steady_clock::now();
    std::size_t const runs = sweep.runs();
    Steps steps{source,
                experiment,
                options,
                folder,
                std::vector<SweepRow>(runs),
                std::vector<std::vector<std::string>>(runs),
                std::vector<char>(runs, 0),
                {}};
    run_all(steps, runs);

    std::vector<std::string> keys;
    for (SweepAxis const& axis : sweep.axes)
        keys.push_back(axis.key);
    RunResult result;
    for (auto const& failures : steps.failures)
        result.failures.insert(result.failures.end(), failures.begin(), failures.end());
    double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.summary = sweep_summary(keys, steps.rows, source.set, result.failures, {seconds, steps.kept});
    if (!folder.empty()) {
        write_text(folder / "summary.json", to_json(result.summary) + "\n");
        write_text(folder / "sweep.csv", sweep_csv(keys, steps.rows));
        write_page(folder, steps.first, result.summary, keys, steps.rows);
    }
    return result;
}

void write_sweep_page(ExperimentSource const& source, fs::path const& folder, Value const& summary) {
    Experiment const experiment = read_experiment(source.tree, source.file);
    std::vector<SweepRow> rows;
    for (std::size_t i = 0; i < experiment.sweep.runs(); ++i) {
        fs::path const place = folder / "runs" / run_name(i);
        auto run = kept_summary(place);
        if (!run)
            throw InputError(place.string(), "has no summary.json", "make the sweep again");
        rows.push_back({experiment.sweep.point(i), std::move(*run)});
    }
    if (rows.empty())
        throw InputError(source.file.string(), "has no sweep, though the run has one", "give its experiment");
    Step const step = step_of(source, experiment.sweep, 0);
    OneRun const first = drawn_again(step.source, read_experiment(step.source.tree, step.source.file),
                                     rows.front().summary, folder / "runs" / run_name(0), nullptr);
    std::vector<std::string> keys;
    for (SweepAxis const& axis : experiment.sweep.axes)
        keys.push_back(axis.key);
    write_page(folder, first, summary, keys, rows);
}

namespace {

void add_file(fs::path const& file, Table& files) {
    std::error_code error;
    files.emplace_back(file.string(), of(sha256(file_text(file))));
    for (fs::directory_entry const& entry : fs::directory_iterator(file.parent_path(), error)) {
        auto const ending = entry.path().extension();
        if ((ending == ".mtl" || ending == ".bin") && entry.is_regular_file(error))
            files.emplace_back(entry.path().string(),
                               of(std::to_string(entry.file_size(error)) + " " +
                                  std::to_string(entry.last_write_time(error).time_since_epoch().count())));
    }
}

/// Every text of the tree that is the name of a file.
void add_files(Value const& value, fs::path const& base, Table& files) {
    if (auto const* table = std::get_if<Table>(&value.data))
        for (auto const& [key, entry] : *table)
            add_files(entry, base, files);
    else if (auto const* array = std::get_if<Array>(&value.data))
        for (Value const& item : *array)
            add_files(item, base, files);
    else if (auto const* text = std::get_if<std::string>(&value.data)) {
        std::error_code error;
        if (!text->empty() && fs::is_regular_file(base / *text, error))
            add_file(fs::absolute(base / *text), files);
    }
}

} // namespace

std::string sweep_identity(ExperimentSource const& source) {
    Table files;
    add_files(source.tree, source.file.parent_path(), files);
    std::sort(files.begin(), files.end(), [](auto const& a, auto const& b) {
        return std::pair(a.first, to_json(a.second)) < std::pair(b.first, to_json(b.second));
    });
    return to_json(of(Table{{"program", of(program_name())},
                            {"experiment", of(fs::absolute(source.file).string())},
                            {"experiment_sha256", of(sha256(source.text))},
                            {"set", of(source.set)},
                            {"files", of(std::move(files))}})) +
           "\n";
}

} // namespace sahl

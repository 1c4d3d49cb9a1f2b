#include "run/run.h"

#include "math/input_error.h"
#include "report/page.h"
#include "run/detector_files.h"
#include "run/polarisation_pilot.h"
#include "run/run_folder.h"
#include "run/sha256.h"
#include "run/summary.h"
#include "run/sweep_table.h"
#include "scene/read_model.h"

#include <cstdio>
#include <fstream>

namespace sahl {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t rays_on_page = 150; // enough to see the light, few enough to see each ray

void write_text(fs::path const& file, std::string const& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    if (!out.flush())
        throw InputError(file.string(), "cannot be written", "see that there is room on the disk");
}

LogHeader log_header(ExperimentSource const& source, Experiment const& experiment, Scene const& scene,
                     WavelengthTable const& optics, Emission const& emission, RunFacts const& facts) {
    LogHeader header;
    header.program = facts.program;
    header.title = experiment.title;
    header.experiment_text = source.text;
    header.options_json = to_json(options_of(experiment, facts));
    header.experiment_sha256 = facts.experiment_sha256;
    header.seed = experiment.trace.seed;
    header.every = experiment.log.every;
    header.min_power = experiment.log.min_power;
    for (SourceSpec const& spec : scene.sources) {
        header.sources.push_back(spec.name);
        header.source_power_W.push_back(spec.power);
    }
    header.source_first_ray = emission.first_rays();
    for (Face const& face : scene.faces)
        header.surfaces.push_back(face.name);
    for (std::uint32_t medium = 0; medium < scene.media.size(); ++medium) {
        header.media.push_back(scene.media[medium].name);
        for (std::uint32_t w = 0; w < optics.wavelengths().size(); ++w)
            header.refractive_index.push_back(optics.index({medium}, {w}));
    }
    header.models = scene.models;
    header.wavelengths_m = optics.wavelengths();
    return header;
}

/// Whole trees of a few rays, evenly spread, for the page.
std::vector<Segment> sample_paths(Scene const& scene, WavelengthTable const& optics, Emission const& emission,
                                  TraceOptions const& options, std::uint64_t& shown) {
    TraceContext const context{scene, optics, emission, options, power_unit(emission), 1};
    std::vector<Segment> paths;
    shown = std::min(rays_on_page, emission.rays());
    for (std::uint64_t i = 0; i < shown; ++i) {
        std::uint64_t const ray = shown > 1 ? (emission.rays() - 1) * i / (shown - 1) : 0;
        auto const tree = trace_batch(context, ray, 1).log.segments;
        paths.insert(paths.end(), tree.begin(), tree.end());
    }
    return paths;
}

struct OneRun {
    Scene scene;
    Value summary;
    std::vector<std::string> failures;
    std::vector<std::string> pictures; // relative to the folder
    std::vector<Segment> paths;
    std::uint64_t rays_shown = 0;
};

OneRun run_once(ExperimentSource const& source, Experiment const& experiment, RunOptions const& options,
                fs::path const& folder) {
    OneRun run;
    run.scene = build_scene(experiment);
    WavelengthTable const optics(run.scene);
    Emission const emission(run.scene.sources, optics, experiment.trace.seed);
    RunFacts const facts{program_name(), sha256(source.text), source.set};

    for (std::string& warning : unclosed_warnings(run.scene))
        run.scene.warnings.push_back(std::move(warning));
    if (experiment.trace.polarised == Polarised::automatic)
        for (std::string& warning : polarisation_warnings(run.scene, optics, emission, experiment.trace))
            run.scene.warnings.push_back(std::move(warning));

    std::optional<RayLogWriter> log;
    bool const writes = !folder.empty();
    if (options.log_file || (experiment.log.on && writes))
        log.emplace(options.log_file.value_or(folder / "rays.h5"),
                    log_header(source, experiment, run.scene, optics, emission, facts),
                    RayLogOptions{experiment.log.compress, whole_chunks(experiment.log.shard_rows)});
    TraceOutcome const outcome = trace_scene(run.scene, optics, emission, experiment.trace, options.threads,
                                             log ? &*log : nullptr, experiment.log, options.progress);
    if (log)
        log->close();
    for (std::string& warning : hole_warnings(run.scene, outcome.holes))
        run.scene.warnings.push_back(std::move(warning));
    run.summary = summary_of(experiment, run.scene, optics, outcome, facts);
    run.failures = failures_of(experiment, outcome);
    if (!writes)
        return run;
    fs::create_directories(folder);
    for (DetectorRecord const& record : outcome.detectors)
        if (std::string const picture =
                write_detector_files(record, folder / "detectors", experiment.title, optics.wavelengths());
            !picture.empty())
            run.pictures.push_back("detectors/" + picture);
    write_text(folder / "summary.json", to_json(run.summary) + "\n");
    run.paths = sample_paths(run.scene, optics, emission, experiment.trace, run.rays_shown);
    return run;
}

void write_page(fs::path const& folder, OneRun const& run, Value const& summary, std::string const& key,
                std::vector<SweepRow> const& rows) {
    if (!folder.empty())
        write_text(folder / "report.html",
                   report_page({summary, run.scene, run.paths, run.rays_shown, run.pictures, key, rows}));
}

/// The experiment with the sweep taken out and its key set.
ExperimentSource at_step(ExperimentSource const& source, SweepAxis const& axis, double value) {
    ExperimentSource step = source;
    std::erase_if(std::get<Table>(step.tree.data), [](auto const& entry) { return entry.first == "sweep"; });
    set_key(step.tree, axis.key, Value{value, axis.place});
    char text[64];
    std::snprintf(text, sizeof text, "=%.17g", value);
    step.set.push_back(axis.key + text);
    return step;
}

RunResult run_sweep(ExperimentSource const& source, SweepAxis const& axis, RunOptions const& options,
                    fs::path const& folder) {
    if (options.log_file)
        throw InputError(
            axis.place.text(), "a sweep makes a run, and a log, for each value",
            "leave --log FILE away and set trace.log = true: each run's log stands in its own folder");
    std::vector<SweepRow> rows;
    std::optional<OneRun> first;
    RunResult result;
    for (std::size_t i = 0; i < axis.values.size(); ++i) {
        if (options.sweep_progress)
            options.sweep_progress(i, axis.values.size());
        ExperimentSource const step = at_step(source, axis, axis.values[i]);
        char name[32];
        std::snprintf(name, sizeof name, "%03zu", i);
        fs::path const step_folder = folder.empty() ? folder : folder / "runs" / name;
        if (!folder.empty())
            fs::create_directories(step_folder);
        OneRun run = run_once(step, read_experiment(step.tree, step.file), options, step_folder);
        write_page(step_folder, run, run.summary, {}, {});
        for (std::string const& failure : run.failures)
            result.failures.push_back(axis.key + " = " + std::to_string(axis.values[i]) + ": " + failure);
        rows.push_back({axis.values[i], run.summary});
        if (!first)
            first = std::move(run);
    }
    result.summary = sweep_summary(axis.key, rows, source.set, result.failures);
    if (!folder.empty()) {
        write_text(folder / "summary.json", to_json(result.summary) + "\n");
        write_text(folder / "sweep.csv", sweep_csv(axis.key, rows));
        for (std::string& picture : first->pictures)
            picture = "runs/000/" + picture;
        write_page(folder, *first, result.summary, axis.key, rows);
    }
    return result;
}

} // namespace

std::string program_name() {
    return "sahl " SAHL_VERSION;
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

RunResult run_experiment(ExperimentSource const& source, RunOptions const& options) {
    Experiment const experiment =
        read_experiment(source.tree, source.file); // all errors of input, before a file is made
    std::optional<RunFolder> folder;
    if (!options.out.empty())
        folder.emplace(options.out);
    fs::path const work = folder ? folder->path() : fs::path();
    RunResult result;
    if (!experiment.sweep.empty()) {
        result = run_sweep(source, experiment.sweep.front(), options, work);
    } else {
        OneRun run = run_once(source, experiment, options, work);
        write_page(work, run, run.summary, {}, {});
        result = {std::move(run.summary), std::move(run.failures)};
    }
    if (folder)
        folder->publish();
    return result;
}

} // namespace sahl

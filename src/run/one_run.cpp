#include "run/one_run.h"

#include "math/input_error.h"
#include "report/page.h"
#include "run/detector_files.h"
#include "run/method_choice.h"
#include "run/normal_warnings.h"
#include "run/polarisation_pilot.h"
#include "run/summary.h"

#include <algorithm>
#include <fstream>

namespace sahl {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t rays_on_page = 150; // enough to see the light, few enough to see each ray

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
    header.digits_lost = experiment.trace.digits_lost;
    header.where = experiment.log.where.text;
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

} // namespace

void write_text(fs::path const& file, std::string const& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    if (!out.flush())
        throw InputError(file.string(), "cannot be written", "see that there is room on the disk");
}

OneRun run_once(ExperimentSource const& source, Experiment const& experiment, RunOptions const& options,
                fs::path const& folder) {
    OneRun run;
    run.scene = build_scene(experiment, options.models);
    WavelengthTable const optics(run.scene);
    Emission const emission(run.scene.sources, optics, experiment.trace.seed);
    RunFacts const facts{program_name(), experiment_sha256(source), source.set};
    MethodChoice choice;
    if (experiment.trace.method == Method::automatic)
        choice = choose_methods(run.scene, optics, emission, experiment.trace);
    else
        choice.warnings = normal_warnings(run.scene);
    for (std::string& warning : choice.warnings)
        run.scene.warnings.push_back(std::move(warning));

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
                    RayLogOptions{experiment.log.compress, whole_chunks(experiment.log.shard_rows)},
                    options.resume ? LogStart::where_it_was_stopped : LogStart::anew);
    TraceOutcome const outcome = trace_scene(run.scene, optics, emission, experiment.trace, options.threads,
                                             log ? &*log : nullptr, experiment.log, options.progress);
    if (log)
        log->close();
    for (std::string& warning : hole_warnings(run.scene, outcome.holes))
        run.scene.warnings.push_back(std::move(warning));
    run.summary = summary_of(experiment, run.scene, optics, outcome, facts, choice);
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

OneRun drawn_again(Experiment const& experiment, Value summary, fs::path const& folder, ModelCache* models) {
    OneRun run;
    run.scene = build_scene(experiment, models);
    WavelengthTable const optics(run.scene);
    Emission const emission(run.scene.sources, optics, experiment.trace.seed);
    if (experiment.trace.method == Method::automatic)
        choose_methods(run.scene, optics, emission, experiment.trace);
    run.summary = std::move(summary);
    if (auto const* failures = run.summary.find("failures"))
        for (Value const& failure : std::get<Array>(failures->data))
            run.failures.push_back(std::get<std::string>(failure.data));
    if (fs::is_directory(folder / "detectors"))
        for (fs::directory_entry const& entry : fs::directory_iterator(folder / "detectors"))
            if (entry.path().extension() == ".png")
                run.pictures.push_back("detectors/" + entry.path().filename().string());
    run.paths = sample_paths(run.scene, optics, emission, experiment.trace, run.rays_shown);
    return run;
}

void write_page(fs::path const& folder, OneRun const& run, Value const& summary,
                std::vector<std::string> const& keys, std::vector<SweepRow> const& rows) {
    if (!folder.empty())
        write_text(folder / "report.html",
                   report_page({summary, run.scene, run.paths, run.rays_shown, run.pictures, keys, rows}));
}

} // namespace sahl

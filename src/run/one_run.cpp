#include "run/one_run.h"

#include "math/input_error.h"
#include "math/random.h"
#include "report/page.h"
#include "run/detector_files.h"
#include "run/method_choice.h"
#include "run/page_detectors.h"
#include "run/summary.h"
#include "run/unfinished.h"

#include <algorithm>
#include <fstream>

namespace sahl {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t rays_at_once = 1024;

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

/// Whole trees of rays, spread evenly but not in step with a pattern's rows, so many that they have about
/// `segments` where there are so many.
///   each   segments that a ray has on average
PagePaths sample_paths(Scene const& scene, WavelengthTable const& optics, Emission const& emission,
                       TraceOptions const& options, std::size_t segments, double each) {
    TraceContext const context{scene, optics, emission, options, power_unit(emission), 1};
    double const wanted = std::max(1.0, static_cast<double>(segments) / std::max(1.0, each));
    std::uint64_t const rays = emission.rays();
    bool const all = static_cast<double>(rays) <= wanted;
    std::uint64_t const shown = all ? rays : static_cast<std::uint64_t>(wanted);
    PagePaths paths;
    paths.rays = shown;
    std::uint64_t next = 0;
    for (std::uint64_t i = 0; i < shown && paths.segments.size() < 4 * segments;
         i += all ? rays_at_once : 1) {
        std::uint64_t const end = all ? rays : (i + 1) * (rays / shown) + (i + 1) * (rays % shown) / shown;
        std::uint64_t const ray = all ? i : next + mix64(i) % (end - next);
        auto const tree = trace_batch(context, ray, all ? std::min(rays_at_once, rays - i) : 1).log.segments;
        paths.segments.insert(paths.segments.end(), tree.begin(), tree.end());
        next = end;
    }
    return thinned(paths, segments);
}

void stop_if_asked(RunOptions const& options) {
    if (options.stop && *options.stop)
        throw RunStopped();
}

double segments_of_a_ray(Value const& summary) {
    auto const number = [&](char const* key) {
        Value const* const found = summary.find(key);
        return found && std::holds_alternative<std::int64_t>(found->data)
                   ? static_cast<double>(std::get<std::int64_t>(found->data))
                   : 0.0;
    };
    return number("segments") / std::max(1.0, number("rays"));
}

} // namespace

void write_text(fs::path const& file, std::string const& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    if (!out.flush())
        throw InputError(file.string(), "cannot be written", "see that there is room on the disk");
}

OneRun run_once(ExperimentSource const& source, Experiment const& experiment, RunOptions const& options,
                fs::path const& folder, std::size_t segments) {
    OneRun run;
    run.scene = build_scene(experiment, options.models);
    WavelengthTable const optics(run.scene);
    Emission const emission(run.scene.sources, optics, experiment.trace.seed);
    RunFacts const facts{program_name(), experiment_sha256(source), source.set};
    stop_if_asked(options);
    MethodChoice choice = settle_methods(run.scene, optics, emission, experiment.trace);
    for (std::string& warning : choice.warnings)
        run.scene.warnings.push_back(std::move(warning));

    for (std::string& warning : unclosed_warnings(run.scene))
        run.scene.warnings.push_back(std::move(warning));
    stop_if_asked(options);
    Pilots const pilots = send_pilots(run.scene, optics, emission, experiment.trace);
    if (pilots.polarisation)
        for (std::string& warning :
             polarisation_warnings(*pilots.polarisation, experiment.trace.tolerance_power))
            run.scene.warnings.push_back(std::move(warning));

    run.names = log_header(source, experiment, run.scene, optics, emission, facts);
    std::optional<RayLogWriter> log;
    bool const writes = !folder.empty();
    if (options.log_file || (experiment.log.on && writes))
        log.emplace(options.log_file.value_or(folder / "rays.h5"), run.names,
                    RayLogOptions{experiment.log.compress, whole_chunks(experiment.log.shard_rows)},
                    options.resume ? LogStart::where_it_was_stopped : LogStart::anew);
    std::optional<KnownSoFar> known;
    if (!log && writes && options.keep_every_s)
        known = known_in(folder, options.resume, *options.keep_every_s);
    TraceOutcome const outcome =
        trace_scene(run.scene, optics, emission, experiment.trace, options.threads, log ? &*log : nullptr,
                    experiment.log, options.progress, known ? &*known : nullptr, options.stop);
    if (!outcome.whole) {
        if (log)
            log->leave();
        throw RunStopped();
    }
    if (log)
        log->close();
    for (std::string& warning : hole_warnings(run.scene, outcome.holes))
        run.scene.warnings.push_back(std::move(warning));
    run.summary = summary_of(experiment, run.scene, optics, outcome, facts, choice, pilots);
    run.failures = failures_of(experiment, outcome);
    if (!writes)
        return run;
    fs::create_directories(folder);
    for (DetectorRecord const& record : outcome.detectors)
        write_detector_files(record, folder / "detectors", experiment.title, optics.wavelengths());
    write_text(folder / "summary.json", to_json(run.summary) + "\n");
    run.detectors = page_detectors(outcome.detectors);
    run.paths =
        sample_paths(run.scene, optics, emission, experiment.trace, segments, segments_of_a_ray(run.summary));
    return run;
}

OneRun drawn_again(ExperimentSource const& source, Experiment const& experiment, Value summary,
                   fs::path const& folder, ModelCache* models) {
    OneRun run;
    run.scene = build_scene(experiment, models);
    WavelengthTable const optics(run.scene);
    Emission const emission(run.scene.sources, optics, experiment.trace.seed);
    settle_methods(run.scene, optics, emission, experiment.trace);
    run.summary = std::move(summary);
    if (auto const* failures = run.summary.find("failures"))
        for (Value const& failure : std::get<Array>(failures->data))
            run.failures.push_back(std::get<std::string>(failure.data));
    run.names = log_header(source, experiment, run.scene, optics, emission,
                           {program_name(), experiment_sha256(source), source.set});
    run.detectors = page_detectors(run.scene.detectors, folder / "detectors");
    run.paths = sample_paths(run.scene, optics, emission, experiment.trace, most_page_segments,
                             segments_of_a_ray(run.summary));
    return run;
}

void write_page(fs::path const& folder, OneRun const& run, Value const& summary,
                std::vector<std::string> const& keys, std::vector<SweepRow> const& rows,
                std::size_t segments) {
    if (!folder.empty())
        write_text(folder / "report.html", report_page({summary,
                                                        run.scene,
                                                        run.names,
                                                        thinned(run.paths, segments),
                                                        run.detectors,
                                                        keys,
                                                        rows,
                                                        {}}));
}

} // namespace sahl

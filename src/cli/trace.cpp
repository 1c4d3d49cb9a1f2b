#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/stop.h"

#include "math/input_error.h"
#include "run/run.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <iostream>
#include <memory>

namespace sahl {

namespace {

struct TraceArguments {
    std::string experiment, out, seed, tolerance, method, log;
    std::vector<std::string> set;
    unsigned threads = 0;
    bool json = false, quiet = false, resume = false;
    double keep_every_s = *RunOptions().keep_every_s;
};

/// --seed, --tolerance, --method and --log are --set under shorter names.
std::vector<std::string> settings(TraceArguments const& arguments) {
    std::vector<std::string> set = arguments.set;
    auto const also = [&](char const* key, std::string const& value) {
        if (!value.empty())
            set.push_back(std::string(key) + "=" + value);
    };
    also("trace.seed", arguments.seed);
    also("trace.tolerance_rad", arguments.tolerance);
    also("trace.method", arguments.method.empty() ? "" : "\"" + arguments.method + "\"");
    if (arguments.log == "none")
        set.emplace_back("trace.log=false");
    return set;
}

double number(Value const* value) {
    if (value && std::holds_alternative<std::int64_t>(value->data))
        return static_cast<double>(std::get<std::int64_t>(value->data));
    return value && std::holds_alternative<double>(value->data) ? std::get<double>(value->data) : 0.0;
}

void print_summary(RunResult const& result, std::filesystem::path const& out) {
    Value const& summary = result.summary;
    Value const& energy = *summary.find("energy_W");
    std::printf("%s\n", std::get<std::string>(summary.find("title")->data).c_str());
    std::printf("  %.0f rays, %.0f segments in %.3g s (%.3g million a second)\n",
                number(summary.find("rays")), number(summary.find("segments")),
                number(summary.find("seconds")), number(summary.find("segments_per_second")) * 1e-6);
    double const emitted = number(energy.find("emitted"));
    std::printf("  emitted %.9g W =", emitted);
    char const* plus = "";
    for (char const* term : {"detected", "absorbed", "escaped", "cut", "error"}) {
        std::printf("%s %s %.6g", plus, term, number(energy.find(term)));
        plus = " +";
    }
    std::printf("; remainder %.3g\n", number(energy.find("remainder")));
    if (Value const* const detectors = summary.find("detectors"))
        for (auto const& [name, figures] : std::get<Table>(detectors->data))
            std::printf("  %s: %.9g W in %.0f hits\n", name.c_str(), number(figures.find("power_W")),
                        number(figures.find("hits")));
    if (Value const* const warnings = summary.find("warnings"))
        for (Value const& warning : std::get<Array>(warnings->data))
            std::printf("  warning: %s\n", std::get<std::string>(warning.data).c_str());
    std::printf("  results in %s, to look at: %s\n", out.c_str(), (out / "report.html").c_str());
}

int run_trace(TraceArguments const& arguments) {
    ExperimentSource const source = load_experiment(arguments.experiment, settings(arguments));
    RunOptions options;
    options.out = arguments.out.empty() ? std::filesystem::path("out") / source.file.stem()
                                        : std::filesystem::path(arguments.out);
    options.threads = arguments.threads;
    options.resume = arguments.resume;
    options.keep_every_s = arguments.keep_every_s;
    if (!arguments.log.empty() && arguments.log != "none")
        options.log_file = arguments.log;
    options.stop = &stop_on_signals();
    RunResult result;
    try {
        ProgressLine line(arguments.quiet);
        options.progress = [&](std::uint64_t done, std::uint64_t total) { line.show(done, total); };
        options.sweep_progress = [&](std::size_t step, std::size_t steps) {
            line.begin("runs done: " + std::to_string(step) + " of " + std::to_string(steps));
        };
        result = run_experiment(source, options);
    } catch (RunStopped const& stopped) {
        std::cerr << "sahl: stopped"
                  << (stopped.kept.empty()
                          ? std::string()
                          : "; --resume goes on from what was done, in " + stopped.kept.string())
                  << "\n";
        return status_when_stopped();
    }
    if (arguments.json)
        std::cout << to_json(result.summary) << "\n";
    else if (!arguments.quiet)
        print_summary(result, options.out);
    for (std::string const& failure : result.failures)
        std::cerr << "sahl: " << failure << "\n";
    return result.failures.empty() ? 0 : 4;
}

} // namespace

void add_trace(CLI::App& app, int& status) {
    auto arguments = std::make_shared<TraceArguments>();
    CLI::App* const command = app.add_subcommand(
        "trace", "Run an experiment: summary, detectors, report, and a log of the rays if asked for");
    command->add_option("experiment", arguments->experiment, "The experiment file (TOML, or JSON)")
        ->required();
    command->add_option("--out", arguments->out, "Folder of the results (default: out/<experiment name>)");
    command
        ->add_option("--set", arguments->set,
                     "KEY=VALUE: set a key of the experiment, e.g. object.prism.turn_deg[2]=10")
        ->take_all()
        ->allow_extra_args(false);
    command->add_option("--seed", arguments->seed, "Seed of the random numbers")
        ->check([](std::string const& text) {
            bool const digits = text.find_first_not_of("0123456789") == std::string::npos;
            return digits ? std::string() : "give a whole number from 0 on, and not " + text;
        });
    command->add_option("--threads", arguments->threads,
                        "Threads; 0: all there are. The results are the same");
    command->add_option("--tolerance", arguments->tolerance, "The direction error you can bear, rad")
        ->check([](std::string const& text) {
            double value = 0.0;
            bool const good = CLI::detail::lexical_cast(text, value) && value > 0.0;
            return good ? std::string() : "give a number above 0, in rad, and not " + text;
        });
    command
        ->add_option("--method", arguments->method,
                     "How meshes are met: auto, facet, interpolated, quadratic, fitted, recognised")
        ->check(CLI::IsMember({"auto", "facet", "interpolated", "quadratic", "fitted", "recognised"}));
    command->add_option("--log", arguments->log, "none, or a file for the log of the rays");
    command->add_flag("--resume", arguments->resume, "Go on where a run of this experiment was stopped");
    command
        ->add_option("--keep-every", arguments->keep_every_s,
                     "Seconds after which what is known so far is kept for --resume")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_flag("--json", arguments->json, "The summary on standard output");
    command->add_flag("--quiet", arguments->quiet, "Say nothing but errors");
    command->callback([arguments, &status] { status = run_trace(*arguments); });
}

} // namespace sahl

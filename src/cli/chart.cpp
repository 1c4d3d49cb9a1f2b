// The command that traces the same rays by every method and draws what accuracy costs.
#include "cli/commands.h"

#include "report/method_page.h"
#include "report/method_scatter.h"
#include "run/method_chart.h"
#include "run/one_run.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace sahl {

namespace {

struct ChartArguments {
    std::string experiment, exact, out;
    std::vector<std::string> set;
    bool quiet = false;
};

int run_chart(ChartArguments const& arguments) {
    ExperimentSource const source = load_experiment(arguments.experiment, arguments.set);
    std::optional<ExperimentSource> exact;
    if (!arguments.exact.empty())
        exact = load_experiment(arguments.exact, arguments.set);
    MethodChart const chart = method_chart(source, exact);
    std::filesystem::path const out =
        arguments.out.empty() ? std::filesystem::path("out") / (source.file.stem().string() + "-chart")
                              : std::filesystem::path(arguments.out);
    std::vector<report::ScatterPoint> points;
    for (MethodFigures const& m : chart.methods)
        points.push_back({m.method, m.ns_per_segment, m.rms, m.greatest, m.front, m.leaving, m.changed});
    std::filesystem::create_directories(out);
    write_text(out / "chart.csv", chart_csv(chart));
    write_text(out / "chart.json", to_json(chart_value(chart)) + "\n");
    write_text(out / "chart.svg", report::method_scatter_svg(points, chart.title, chart.reference));
    write_text(out / "chart.html", report::method_page(points, chart.title, chart.reference));
    if (arguments.quiet)
        return 0;
    std::printf("%s: errors against %s\n", chart.title.c_str(), chart.reference.c_str());
    std::printf("  %-13s %12s %12s %12s %12s %10s\n", "method", "ns/segment", "RMS, rad", "leaving",
                "max, rad", "changed");
    for (MethodFigures const& m : chart.methods)
        std::printf("%s %-13s %12.4g %12.3g %12.3g %12.3g %9.3g%%\n", m.front ? "*" : " ", m.method.c_str(),
                    m.ns_per_segment, m.rms, m.leaving, m.greatest, 100.0 * m.changed);
    for (std::string const& warning : chart.warnings)
        std::printf("  warning: %s\n", warning.c_str());
    std::printf("  *: no other method is both faster and nearer; written to %s\n", out.c_str());
    return 0;
}

} // namespace

void add_chart(CLI::App& app, int& status) {
    auto arguments = std::make_shared<ChartArguments>();
    CLI::App* const command =
        app.add_subcommand("chart", "The same rays by every method: time against error");
    command->add_option("experiment", arguments->experiment, "An experiment with a closed mesh")->required();
    command->add_option("--exact", arguments->exact,
                        "The same experiment with exact shapes, which errors are then held against");
    command->add_option(
        "--out", arguments->out,
        "Folder of chart.csv, .json, .svg and .html, that of a run perhaps (default: out/<name>-chart)");
    command->add_option("--set", arguments->set, "KEY=VALUE: set a key of the experiment")
        ->take_all()
        ->allow_extra_args(false);
    command->add_flag("--quiet", arguments->quiet, "Say nothing but errors");
    command->callback([arguments, &status] { status = run_chart(*arguments); });
}

} // namespace sahl

// The commands that look at something: check an experiment or model, explain a ray.
#include "cli/commands.h"

#include "math/input_error.h"
#include "record/detector_normals.h"
#include "record/explain.h"
#include "record/read_rays.h"
#include "run/check.h"
#include "scene/read_model.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <memory>

namespace sahl {

void add_check(CLI::App& app, int& status) {
    struct Arguments {
        std::string file;
        std::vector<std::string> set;
        bool json = false, fit = false;
        double tolerance = TraceOptions{}.tolerance;
    };
    auto arguments = std::make_shared<Arguments>();
    CLI::App* const command =
        app.add_subcommand("check", "What is in an experiment or a model, and what would go wrong");
    command->add_option("file", arguments->file, "An experiment file, or a model (.gltf, .glb, .obj)")
        ->required();
    command->add_option("--set", arguments->set, "KEY=VALUE: set a key of the experiment")
        ->take_all()
        ->allow_extra_args(false);
    command->add_flag("--fit", arguments->fit,
                      "What fineness each mesh carries: errors by method, and triangles for the tolerance");
    auto* const tolerance =
        command
            ->add_option("--tolerance", arguments->tolerance,
                         "With --fit: the direction error you can bear, rad (default: the experiment's)")
            ->check(CLI::PositiveNumber);
    command->add_flag("--json", arguments->json, "As JSON on standard output");
    command->callback([arguments, tolerance, &status] {
        auto const& [file, set, json, fit, bearable] = *arguments;
        std::vector<std::string> settings = set;
        if (!tolerance->empty())
            settings.push_back(std::string("trace.tolerance_rad=") + tolerance->results().front());
        Value const report = is_model_file(file) || is_foreign_model_file(file)
                                 ? check_model(file, fit ? std::optional(bearable) : std::nullopt)
                                 : check_experiment(load_experiment(file, settings), fit);
        std::cout << (json ? to_json(report) + "\n" : check_text(report));
        status = 0;
    });
}

namespace {

/// The rows of one ray, or those of its selected paths, or those of the first ray that has any.
std::string explained(RayLogReader const& reader, std::optional<std::uint64_t> ray,
                      std::optional<PathFilter> const& filter, std::string const& file) {
    std::vector<Segment> rows;
    if (ray) {
        rows = reader.read_ray(*ray);
        if (rows.empty())
            throw InputError(file, "has no ray " + std::to_string(*ray),
                             reader.rays() == 0 ? "the log is empty"
                                                : "its last is ray " + std::to_string(reader.rays() - 1));
    } else {
        read_rays(reader, filter ? &*filter : nullptr, [&](std::span<Segment const> found) {
            rows = reader.read_ray(found.front().ray);
            return false;
        });
    }
    std::vector<char> drawn(rows.size(), 1);
    if (filter && !rows.empty()) {
        SelectedPaths paths(*filter);
        paths.take(rows);
        drawn = paths.kept();
    }
    if (std::count(drawn.begin(), drawn.end(), char{1}) == 0)
        throw InputError(file,
                         (ray ? "ray " + std::to_string(*ray) + " has" : std::string("has")) +
                             " no path that is selected",
                         "give another --where");
    return explain_ray(reader.header(), rows, filter ? &drawn : nullptr, detector_normals(reader.header()));
}

} // namespace

void add_explain(CLI::App& app, int& status) {
    struct Arguments {
        std::string log, where;
        std::uint64_t ray = 0;
    };
    auto arguments = std::make_shared<Arguments>();
    CLI::App* const command =
        app.add_subcommand("explain", "One ray's tree as text, with the reason for every split");
    command->add_option("log", arguments->log, "The folder of a run, or its rays.h5")->required();
    auto* const ray = command->add_option("--ray", arguments->ray, "The ray's number, from 0");
    auto* const where = command->add_option(
        "--where", arguments->where,
        "A path filter: only the branches that it selects; without --ray of the first ray that has any");
    command->callback([arguments, ray, where, &status] {
        if (ray->empty() && where->empty())
            throw CLI::RequiredError("--ray N or --where FILTER");
        RayLogReader const reader(arguments->log);
        auto const filter = log_filter(reader.header(), arguments->where, "--where");
        std::cout << explained(reader, ray->empty() ? std::nullopt : std::optional(arguments->ray), filter,
                               arguments->log);
        status = 0;
    });
}

} // namespace sahl

// The commands that look at something: check an experiment or model, explain a ray.
#include "cli/commands.h"

#include "math/input_error.h"
#include "record/explain.h"
#include "record/ray_log.h"
#include "run/check.h"
#include "scene/read_model.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>

namespace sahl {

void add_check(CLI::App& app, int& status) {
    struct Arguments {
        std::string file;
        std::vector<std::string> set;
        bool json = false;
    };
    auto arguments = std::make_shared<Arguments>();
    CLI::App* const command =
        app.add_subcommand("check", "What is in an experiment or a model, and what would go wrong");
    command->add_option("file", arguments->file, "An experiment file, or a model (.gltf, .glb, .obj)")
        ->required();
    command->add_option("--set", arguments->set, "KEY=VALUE: set a key of the experiment")
        ->take_all()
        ->allow_extra_args(false);
    command->add_flag("--json", arguments->json, "As JSON on standard output");
    command->callback([arguments, &status] {
        Value const report = is_model_file(arguments->file) || is_foreign_model_file(arguments->file)
                                 ? check_model(arguments->file)
                                 : check_experiment(load_experiment(arguments->file, arguments->set));
        std::cout << (arguments->json ? to_json(report) + "\n" : check_text(report));
        status = 0;
    });
}

void add_explain(CLI::App& app, int& status) {
    struct Arguments {
        std::string log;
        std::uint64_t ray = 0;
    };
    auto arguments = std::make_shared<Arguments>();
    CLI::App* const command =
        app.add_subcommand("explain", "One ray's tree as text, with the reason for every split");
    command->add_option("log", arguments->log, "The folder of a run, or its rays.h5")->required();
    command->add_option("--ray", arguments->ray, "The ray's number, from 0")->required();
    command->callback([arguments, &status] {
        RayLogReader const reader(arguments->log);
        auto const tree = reader.read_ray(arguments->ray);
        if (tree.empty())
            throw InputError(arguments->log, "has no ray " + std::to_string(arguments->ray),
                             reader.rays() == 0 ? "the log is empty"
                                                : "its last is ray " + std::to_string(reader.rays() - 1));
        std::cout << explain_ray(reader.header(), tree);
        status = 0;
    });
}

} // namespace sahl

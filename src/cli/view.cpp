// The command that writes the page of a finished run anew, or that of a model.
#include "cli/commands.h"

#include "run/view.h"
#include "scene/read_model.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <memory>

namespace sahl {

void add_view(CLI::App& app, int& status) {
    struct Arguments {
        std::string what, experiment, out;
    };
    auto arguments = std::make_shared<Arguments>();
    CLI::App* const command = app.add_subcommand(
        "view", "The page of a finished run written anew, or a model and what is wrong with it");
    command->add_option("what", arguments->what, "The folder of a run, or a model (.gltf, .glb, .obj)")
        ->required();
    command->add_option("--experiment", arguments->experiment,
                        "The experiment of the run: its rays are traced again for the page");
    command->add_option("--out", arguments->out,
                        "Folder of a model's page (default: out/<model's name>-view)");
    command->callback([arguments, &status] {
        std::filesystem::path const what = arguments->what;
        bool const model = is_model_file(what) || is_foreign_model_file(what);
        std::filesystem::path const out =
            arguments->out.empty() ? std::filesystem::path("out") / (what.stem().string() + "-view")
                                   : std::filesystem::path(arguments->out);
        auto const experiment = arguments->experiment.empty()
                                    ? std::nullopt
                                    : std::optional<std::filesystem::path>(arguments->experiment);
        std::cout << (model ? view_model(what, out) : view_run(what, experiment)).string() << "\n";
        status = 0;
    });
}

} // namespace sahl

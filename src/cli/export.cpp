// The command that writes what there is in another format: an experiment's bodies, a log's rays.
#include "cli/commands.h"

#include "geometry/tessellate.h"
#include "math/input_error.h"
#include "record/export_csv.h"
#include "record/export_tm25.h"
#include "record/read_rays.h"
#include "run/export_model.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace sahl {

namespace {

struct ExportArguments {
    std::string from, to, detector, where;
    std::vector<std::string> set;
    unsigned fineness = 120;
};

bool is_experiment(std::filesystem::path const& file) {
    return file.extension() == ".toml" || file.extension() == ".json";
}

void export_bodies(ExportArguments const& arguments) {
    std::filesystem::path const to = arguments.to;
    if (to.extension() != ".glb")
        throw InputError(to.string(), "an experiment's bodies are written as .glb only",
                         "give a name that ends in .glb; for rays trace it with a log, and export the run");
    if (!arguments.where.empty())
        throw InputError(arguments.from, "--where goes with a log, and this is an experiment",
                         "give the run's folder, or leave --where away");
    export_model(load_experiment(arguments.from, arguments.set), arguments.fineness, to);
}

void export_rays(ExportArguments const& arguments) {
    std::filesystem::path const to = arguments.to;
    if (!arguments.set.empty())
        throw InputError(arguments.from, "--set goes with an experiment, and this is a log",
                         "give the experiment, or leave --set away");
    RayLogReader const log(arguments.from);
    auto const filter = log_filter(log.header(), arguments.where, "--where");
    PathFilter const* const where = filter ? &*filter : nullptr;
    if (to.extension() == ".csv")
        export_csv(log, to, where);
    else if (to.extension() == ".tm25ray")
        export_tm25(log, arguments.detector, to, where);
    else
        throw InputError(to.string(), "rays are not written in this format",
                         "give a name that ends in .csv or .tm25ray");
}

} // namespace

void add_export(CLI::App& app, int& status) {
    auto arguments = std::make_shared<ExportArguments>();
    CLI::App* const command =
        app.add_subcommand("export", "An experiment's bodies, or a log's rays, in another format");
    command->add_option("from", arguments->from, "An experiment file; or the folder of a run, or its rays.h5")
        ->required();
    command
        ->add_option("--to", arguments->to,
                     "The file to write: .glb of an experiment; .csv or .tm25ray of a log")
        ->required();
    command
        ->add_option("--fineness", arguments->fineness,
                     "Of exact shapes: into how many pieces a full turn is cut")
        ->check(CLI::Range(coarsest_turn, finest_turn))
        ->capture_default_str();
    command->add_option("--detector", arguments->detector,
                        "Of .tm25ray: the detector, or the face, whose rays are written");
    command->add_option("--set", arguments->set, "KEY=VALUE: set a key of the experiment")
        ->take_all()
        ->allow_extra_args(false);
    command->add_option("--where", arguments->where,
                        "A path filter: only the paths of a log that it selects");
    command->callback([arguments, &status] {
        if (is_experiment(arguments->from))
            export_bodies(*arguments);
        else
            export_rays(*arguments);
        status = 0;
    });
}

} // namespace sahl

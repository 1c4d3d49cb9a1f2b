// The command that writes what there is in another format: an experiment's bodies, a log's rays.
#include "cli/commands.h"

#include "geometry/tessellate.h"
#include "math/input_error.h"
#include "record/export_csv.h"
#include "record/export_text.h"
#include "record/export_tm25.h"
#include "record/export_vtp.h"
#include "record/read_rays.h"
#include "run/export_model.h"
#include "run/export_rays.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <optional>

namespace sahl {

namespace {

struct ExportArguments {
    std::string from, to, detector, where, layout, bodies, colour = "wavelength";
    std::vector<std::string> set;
    unsigned fineness = 120;
    double decimate_mm = 0.0, subdivide_mm = 0.0;
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
    for (std::string const& line :
         export_model(load_experiment(arguments.from, arguments.set), arguments.fineness, to,
                      1e-3 * arguments.decimate_mm, 1e-3 * arguments.subdivide_mm))
        std::printf("%s\n", line.c_str());
}

std::optional<ExperimentSource> bodies_of(ExportArguments const& arguments) {
    if (arguments.bodies.empty())
        return {};
    return load_experiment(arguments.bodies);
}

ColourBy colour_by(std::string const& name) {
    return name == "power" ? ColourBy::power : name == "depth" ? ColourBy::depth : ColourBy::wavelength;
}

void export_rays(ExportArguments const& arguments) {
    std::filesystem::path const to = arguments.to;
    if (arguments.decimate_mm > 0.0)
        throw InputError(arguments.from, "--decimate-mm goes with an experiment, and this is a log",
                         "give the experiment, or leave --decimate-mm away");
    if (arguments.subdivide_mm > 0.0)
        throw InputError(arguments.from, "--subdivide-mm goes with an experiment, and this is a log",
                         "give the experiment, or leave --subdivide-mm away");
    if (!arguments.set.empty())
        throw InputError(arguments.from, "--set goes with an experiment, and this is a log",
                         "give the experiment, or leave --set away");
    RayLogReader const log(arguments.from);
    auto const filter = log_filter(log.header(), arguments.where, "--where");
    PathFilter const* const where = filter ? &*filter : nullptr;
    if (to.extension() == ".csv" && arguments.layout == "soltrace")
        export_soltrace(log, to, where);
    else if (to.extension() == ".csv")
        export_csv(log, to, where);
    else if (to.extension() == ".jsonl")
        export_json_lines(log, to, where);
    else if (to.extension() == ".vtp")
        export_vtp(log, to, where);
    else if (to.extension() == ".glb")
        export_rays_glb(log, bodies_of(arguments), arguments.fineness, colour_by(arguments.colour), to,
                        where);
    else if (to.extension() == ".tm25ray")
        export_tm25(log, arguments.detector, to, where);
    else
        throw InputError(to.string(), "rays are not written in this format",
                         "give a name that ends in .csv, .jsonl, .vtp, .glb or .tm25ray");
}

} // namespace

void add_export(CLI::App& app, int& status) {
    auto arguments = std::make_shared<ExportArguments>();
    CLI::App* const command =
        app.add_subcommand("export", "An experiment's bodies, or a log's rays, in another format");
    command->add_option("from", arguments->from, "An experiment file; or the folder of a run, or its rays.h5")
        ->required();
    command
        ->add_option(
            "--to", arguments->to,
            "The file to write: .glb of an experiment; .csv, .jsonl, .vtp, .glb or .tm25ray of a log")
        ->required();
    command
        ->add_option("--fineness", arguments->fineness,
                     "Of exact shapes: into how many pieces a full turn is cut")
        ->check(CLI::Range(coarsest_turn, finest_turn))
        ->capture_default_str();
    CLI::Option* const fewer =
        command
            ->add_option("--decimate-mm", arguments->decimate_mm,
                         "Of meshes: fewer triangles, so that no vertex lies farther off them")
            ->check(CLI::PositiveNumber);
    command
        ->add_option("--subdivide-mm", arguments->subdivide_mm,
                     "Of meshes: more triangles, so near to the curved surface that they stand for")
        ->check(CLI::PositiveNumber)
        ->excludes(fewer);
    command->add_option("--detector", arguments->detector,
                        "Of .tm25ray: the detector, or the face, whose rays are written");
    command
        ->add_option("--layout", arguments->layout,
                     "Of .csv: soltrace for the columns of SolTrace's ray data")
        ->check(CLI::IsMember({"soltrace"}));
    command->add_option("--bodies", arguments->bodies,
                        "Of a log's .glb: the experiment whose bodies stand beside the rays");
    command->add_option("--colour", arguments->colour, "Of a log's .glb: wavelength, power or depth")
        ->check(CLI::IsMember({"wavelength", "power", "depth"}))
        ->capture_default_str();
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

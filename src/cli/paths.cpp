// The command that groups a log's rays by the surfaces and events they met.
#include "cli/commands.h"

#include "record/read_rays.h"
#include "run/paths_report.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>

namespace sahl {

void add_paths(CLI::App& app, int& status) {
    struct Arguments {
        std::string log, where;
        double share = 1e-3;
        bool json = false;
    };
    auto arguments = std::make_shared<Arguments>();
    CLI::App* const command =
        app.add_subcommand("paths", "A log's rays, grouped by the surfaces and events they met");
    command->add_option("log", arguments->log, "The folder of a run, or its rays.h5")->required();
    command->add_option("--where", arguments->where, "A path filter: only the paths that it selects");
    command
        ->add_option("--share", arguments->share,
                     "Paths that carry less than this share of the power that began are summed up as other")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    command->add_flag("--json", arguments->json, "As JSON on standard output");
    command->callback([arguments, &status] {
        RayLogReader const log(arguments->log);
        auto const filter = log_filter(log.header(), arguments->where, "--where");
        PathGroups const found = group_paths(log, filter ? &*filter : nullptr, arguments->share);
        std::cout << (arguments->json ? to_json(paths_value(found, log.header())) + "\n" : paths_text(found));
        status = 0;
    });
}

} // namespace sahl

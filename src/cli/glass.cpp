// The command that asks the catalogue of glasses and metals.
#include "cli/commands.h"

#include "run/glass_report.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>
#include <sstream>

namespace sahl {

namespace {

/// A finite number within [low, high]; CLI::Range lets NaN through.
auto within(double low, double high) {
    return [=](std::string const& text) {
        double number = 0.0;
        bool const good = CLI::detail::lexical_cast(text, number) && number >= low && number <= high;
        if (good)
            return std::string();
        std::ostringstream problem;
        problem << "\"" << text << "\" is not a number from " << low << " to " << high;
        return problem.str();
    };
}

} // namespace

void add_glass(CLI::App& app, int& status) {
    struct Arguments {
        GlassQuestion question;
        double nd = 0.0, vd = 0.0;
        bool json = false;
    };
    auto arguments = std::make_shared<Arguments>();
    CLI::App* const command =
        app.add_subcommand("glass", "The catalogue of glasses, crystals, plastics and metals");
    command->add_option("name", arguments->question.name,
                        "\"N-BK7\", \"SCHOTT:N-BK7\", a part of a name, a pattern with * and ?, or a metal");
    command
        ->add_option("--at", arguments->question.wavelength_nm,
                     "NM: wavelength in standard air; default 587.5618, the d line")
        ->check(within(10.0, 1e6));
    command
        ->add_option("--thickness", arguments->question.thickness_mm,
                     "MM: of the glass that light goes through; default 10")
        ->check(within(1e-9, 1e12));
    auto* const nd =
        command->add_option("--nd", arguments->nd, "The glasses nearest to this index at the d line");
    auto* const vd = command->add_option("--vd", arguments->vd, "The glasses nearest to this Abbe number");
    nd->check(within(0.1, 100.0));
    vd->check(within(0.1, 1e6));
    command->add_option("--count", arguments->question.most, "How many of the nearest; default 10")
        ->check(CLI::Range(1, 100000));
    command
        ->add_option("--catalogue", arguments->question.catalogues,
                     "A catalogue of your own beside the built-in one (.agf, .yml); repeatable")
        ->take_all()
        ->allow_extra_args(false);
    command->add_flag("--json", arguments->json, "As JSON on standard output");
    command->callback([arguments, nd, vd, &status] {
        GlassQuestion& question = arguments->question;
        if (nd->count() > 0)
            question.nd = arguments->nd;
        if (vd->count() > 0)
            question.vd = arguments->vd;
        Value const report = glass_report(question);
        std::cout << (arguments->json ? to_json(report) + "\n" : glass_text(report));
        status = 0;
    });
}

} // namespace sahl

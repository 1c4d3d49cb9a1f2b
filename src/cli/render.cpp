// The command that makes a picture.
#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/stop.h"

#include "run/model_picture.h"
#include "run/render.h"
#include "scene/model_cache.h"
#include "scene/read_model.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>

namespace sahl {

namespace {

struct RenderArguments {
    std::string file, glass, seed;
    std::vector<std::string> set, out;
    unsigned threads = 0;
    bool json = false, quiet = false;
};

double number(Value const& summary, char const* key) {
    Value const* const value = summary.find(key);
    return value && value->is_number() ? std::visit(
                                             [](auto const& data) {
                                                 using T = std::decay_t<decltype(data)>;
                                                 if constexpr (std::is_arithmetic_v<T>)
                                                     return static_cast<double>(data);
                                                 else
                                                     return 0.0;
                                             },
                                             value->data)
                                       : 0.0;
}

void print_summary(Value const& summary, std::vector<std::filesystem::path> const& files) {
    double const segments = number(summary, "segments"), seconds = number(summary, "seconds");
    std::printf("%s\n  %.0f × %.0f pixels, %.0f segments in %.3g s (%.3g million a second)\n",
                std::get<std::string>(summary.find("title")->data).c_str(), number(summary, "columns"),
                number(summary, "rows"), segments, seconds, segments / seconds * 1e-6);
    if (number(summary, "leaks") > 0.0)
        std::printf("  %.0f rays were lost\n", number(summary, "leaks"));
    auto const& warnings = std::get<Array>(summary.find("warnings")->data);
    constexpr std::size_t shown = 10;
    for (std::size_t i = 0; i < std::min(shown, warnings.size()); ++i)
        std::printf("  warning: %s\n", std::get<std::string>(warnings[i].data).c_str());
    if (warnings.size() > shown)
        std::printf("  and %zu warnings more: `sahl check` has them all\n", warnings.size() - shown);
    for (auto const& file : files)
        std::printf("  %s\n", file.c_str());
}

int run_render(RenderArguments const& arguments) {
    std::vector<std::string> set = arguments.set;
    if (!arguments.seed.empty())
        set.push_back("trace.seed=" + arguments.seed);
    ModelCache models;
    bool const model = is_model_file(arguments.file) || is_foreign_model_file(arguments.file);
    if (!arguments.glass.empty() && !model)
        throw CLI::ValidationError("--glass", "is for models; in an experiment objects have media");
    ExperimentSource source =
        model ? model_picture(arguments.file, arguments.glass, models) : load_experiment(arguments.file);
    for (std::string const& assignment : set)
        set_key_from_text(source.tree, assignment);
    source.set = set;
    RenderOptions options;
    options.models = &models;
    options.threads = arguments.threads;
    for (std::string const& file : arguments.out)
        options.files.emplace_back(file);
    if (options.files.empty()) {
        std::string const name = source.file.stem().string();
        options.files.push_back(std::filesystem::path("out") / name / (name + ".png"));
    }
    options.stop = &stop_on_signals();
    RenderResult result;
    {
        ProgressLine line(arguments.quiet);
        line.begin("rendering");
        options.progress = [&](std::uint64_t done, std::uint64_t total) { line.show(done, total, "tiles"); };
        result = render_experiment(source, options);
    }
    if (!result.begun) {
        std::cerr << "sahl: stopped before there was anything to write\n";
        return status_when_stopped();
    }
    if (arguments.json)
        std::cout << to_json(result.summary) << "\n";
    else if (!arguments.quiet)
        print_summary(result.summary, options.files);
    if (!result.whole)
        std::cerr << "sahl: stopped; what was done is written\n";
    return result.whole ? 0 : status_when_stopped();
}

} // namespace

void add_render(CLI::App& app, int& status) {
    auto arguments = std::make_shared<RenderArguments>();
    CLI::App* const command = app.add_subcommand("render", "Make a picture of an experiment or a model");
    command->add_option("file", arguments->file, "The experiment file (TOML, or JSON), or a model")
        ->required();
    command->add_option("--glass", arguments->glass,
                        "What a model is made of: a name of the catalogue (default: what its file says, else "
                        "N-BK7)");
    command
        ->add_option("--out", arguments->out,
                     "The picture, .png or .exr; may be given more than once (default: "
                     "out/<experiment name>/<experiment name>.png)")
        ->take_all()
        ->allow_extra_args(false);
    command
        ->add_option("--set", arguments->set,
                     "KEY=VALUE: set a key of the experiment, e.g. camera.fov_deg=20")
        ->take_all()
        ->allow_extra_args(false);
    command->add_option("--seed", arguments->seed, "Seed of the random numbers")
        ->check([](std::string const& text) {
            bool const digits = text.find_first_not_of("0123456789") == std::string::npos;
            return digits ? std::string() : "give a whole number from 0 on, and not " + text;
        });
    command->add_option("--threads", arguments->threads,
                        "Threads; 0: all there are. The picture is the same");
    command->add_flag("--json", arguments->json, "What it took, on standard output");
    command->add_flag("--quiet", arguments->quiet, "Say nothing but errors");
    command->callback([arguments, &status] { status = run_render(*arguments); });
}

} // namespace sahl

#include "run/render.h"

#include "math/input_error.h"
#include "run/light_layer.h"
#include "run/render_scene.h"
#include "run/values.h"
#include "scene/scene.h"

#include <algorithm>
#include <chrono>

namespace sahl {

namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

void check_endings(std::vector<fs::path> const& files) {
    for (fs::path const& file : files)
        if (file.extension() != ".png" && file.extension() != ".exr")
            throw InputError(file.string(), "no picture can be written with this ending",
                             "use .png (8 bits, sRGB) or .exr (linear, with its layers)");
}

using Metadata = std::vector<std::pair<std::string, std::string>>;

void write_files(RenderOptions const& options, Film const& film, PictureOptions const& how,
                 Metadata const& metadata) {
    for (fs::path const& file : options.files) {
        if (file.has_parent_path())
            fs::create_directories(file.parent_path());
        if (file.extension() == ".png")
            write_image(file, srgb_picture(film, how.exposure), metadata);
        else
            write_image(file, linear_layers(film), metadata, layer_names(), how.half_exr);
    }
}

Metadata metadata_of(ExperimentSource const& source, Experiment const& experiment) {
    std::string set;
    for (std::string const& assignment : source.set)
        set += assignment + "\n";
    Metadata metadata{{"Software", program_name()},
                      {"ImageDescription", experiment.title},
                      {"sahl:experiment", source.text},
                      {"sahl:experiment_sha256", experiment_sha256(source)},
                      {"sahl:seed", std::to_string(experiment.trace.seed)}};
    if (!set.empty())
        metadata.emplace_back("sahl:set", set);
    return metadata;
}

/// Before anything is asked of it that tracing needs.
void need_camera(Value const& tree, fs::path const& file) {
    Value const* const objects = tree.find("object");
    auto const* const list = objects ? std::get_if<Array>(&objects->data) : nullptr;
    bool const may_come = list && std::any_of(list->begin(), list->end(),
                                              [](Value const& object) { return object.find("model"); });
    if (!tree.find("camera") && !may_come)
        throw InputError(file.string(), "there is no camera",
                         "add [camera] with at_mm and look_at_mm, in mm");
}

/// Camera and lamps where the experiment has none and its models have some.
void take_from_models(Picture& picture, Scene const& scene, fs::path const& file) {
    if (!picture.camera && !scene.cameras.empty())
        picture.camera = scene.cameras.front();
    if (!picture.camera)
        throw InputError(file.string(), "there is no camera",
                         "add [camera] with at_mm and look_at_mm, in mm");
    if (picture.lights.empty())
        picture.lights = scene.lights;
}

std::uint64_t count(EventCounts const& ended, Event event) {
    return ended[static_cast<std::size_t>(event)];
}

} // namespace

RenderResult render_experiment(ExperimentSource const& source, RenderOptions const& options) {
    check_endings(options.files);
    auto const start = Clock::now();
    need_camera(source.tree, source.file);
    Experiment experiment = read_experiment(source.tree, source.file);
    static std::atomic<bool> const never{false};
    std::atomic<bool> const& stop = options.stop ? *options.stop : never;
    auto const caustics = light_layer(experiment, options.models, options.threads, options.progress, stop);
    experiment.detectors.clear(); // they are no things that could be seen
    Scene scene = build_scene(experiment, options.models);
    take_from_models(*experiment.picture, scene, source.file);
    Picture const& picture = *experiment.picture;
    PictureMaker const maker(scene, picture, experiment.trace, caustics ? &*caustics : nullptr);
    if (stop)
        return {nothing(), false, false};
    double const preparing = seconds_since(start);
    RenderOutcome const outcome =
        render_scene(maker, picture.options, options.threads, options.progress, stop);
    auto const writing = Clock::now();
    write_files(options, outcome.film, picture.options, metadata_of(source, experiment));
    std::uint64_t segments = 0;
    for (std::uint64_t const events : outcome.ended)
        segments += events;
    std::uint64_t const cut = count(outcome.ended, Event::cut_power) + count(outcome.ended, Event::cut_depth);
    std::vector<std::string> warnings = scene.warnings;
    warnings.insert(warnings.end(), maker.warnings().begin(), maker.warnings().end());
    if (auto kept = keeps_all_triangles(experiment))
        warnings.push_back(std::move(*kept));
    Table const table{{"title", of(experiment.title)},
                      {"program", of(program_name())},
                      {"columns", of(std::uint64_t{outcome.film.columns})},
                      {"rows", of(std::uint64_t{outcome.film.rows})},
                      {"samples", of(std::uint64_t{picture.options.samples})},
                      {"trees_a_sample", of(std::uint64_t{maker.wavelengths_a_sample()})},
                      {"pixels_sampled_again", of(outcome.sampled_again)},
                      {"segments", of(segments - cut)},
                      {"cut", of(cut)},
                      {"leaks", of(count(outcome.ended, Event::leak) + count(outcome.ended, Event::invalid))},
                      {"seconds_preparing", of(preparing)},
                      {"seconds", of(outcome.seconds)},
                      {"cpu_seconds", of(outcome.cpu_seconds)},
                      {"seconds_writing", of(seconds_since(writing))},
                      {"threads", of(std::uint64_t{outcome.threads})},
                      {"warnings", of(warnings)}};
    return {of(table), outcome.whole};
}

} // namespace sahl

// In: the tree of a whole experiment. Out: the experiment, its names compared, the steps of its sweep tried
// out.
#include "scene/read_experiment.h"

#include "math/input_error.h"
#include "scene/read_catalogues.h"
#include "scene/read_file.h"
#include "scene/read_media.h"
#include "scene/read_objects.h"
#include "scene/read_options.h"
#include "scene/read_picture.h"
#include "scene/read_sources.h"
#include "scene/read_surfaces.h"
#include "scene/read_sweep.h"

#include <algorithm>
#include <map>

namespace sahl {

namespace {

/// Names are unique over all that has a place in the scene.
void check_names(Experiment const& experiment) {
    std::map<std::string, std::string> owners;
    auto const check = [&](std::string const& kind, auto const& list) {
        for (auto const& item : list) {
            auto const [entry, is_new] = owners.emplace(item.name, kind);
            if (!is_new)
                throw InputError(item.place.text(),
                                 "the " + kind + " \"" + item.name + "\" has the name of another " +
                                     entry->second,
                                 "rename one of them");
        }
    };
    check("object", experiment.objects);
    check("source", experiment.sources);
    check("detector", experiment.detectors);
}

std::vector<double> all_wavelengths(std::vector<SourceSpec> const& sources) {
    std::vector<double> wavelengths;
    for (SourceSpec const& source : sources)
        for (auto const& [wavelength, weight] : source.wavelengths)
            wavelengths.push_back(wavelength);
    std::sort(wavelengths.begin(), wavelengths.end());
    wavelengths.erase(std::unique(wavelengths.begin(), wavelengths.end()), wavelengths.end());
    return wavelengths;
}

/// Beyond the ends of a metal's table they are taken, which is far from the truth in the infrared.
void warn_of_metals(Experiment& experiment, Value const* definitions,
                    std::vector<double> const& wavelengths) {
    for (Surface const& surface : experiment.surfaces) {
        auto const* const metal = std::get_if<Metal>(&surface.kind);
        if (!metal || metal->table.size() < 2)
            continue;
        if (auto warning = range_warning(
                definitions->find(surface.name)->place.text() + ": surface \"" + surface.name + "\"",
                {metal->table.front().wavelength, metal->table.back().wavelength}, wavelengths))
            experiment.warnings.push_back(std::move(*warning));
    }
}

} // namespace

void need_sources(Experiment const& experiment) {
    if (experiment.sources.empty())
        throw InputError(experiment.file.string(), "there is no source of light",
                         "add [[source]] with a name and, for instance, "
                         "beam = {from_mm = [0, 0, -50], toward = [0, 0, 1], radius_mm = 2, rays = 1000}");
}

Value read_experiment_file(std::filesystem::path const& path, std::string& text) {
    text = file_text(path);
    return path.extension() == ".json" ? parse_json(text, path.string()) : parse_toml(text, path.string());
}

Experiment read_experiment(Value const& tree, std::filesystem::path const& file) {
    Fields const top(tree, keys::experiment);
    std::filesystem::path const folder = file.parent_path();
    Experiment experiment;
    experiment.file = file;
    experiment.title = top.has("title") ? top.text("title") : file.stem().string();
    experiment.trace = read_trace(tree);
    experiment.log = read_log(tree);
    experiment.limits = read_limits(tree);
    experiment.picture = std::make_shared<Picture>(read_picture(tree, folder));

    MediaBook media(tree.find("medium"), read_catalogues(tree.find("catalogues"), folder));
    experiment.surroundings = media.refer(top.text("surroundings"), top.place("surroundings"));
    experiment.surfaces = read_surfaces(tree.find("surface"), folder);
    Groups const groups = read_groups(tables_in(tree, "group"));
    experiment.objects = read_objects(tables_in(tree, "object"), media, experiment.surfaces, groups, folder);
    experiment.sources = read_sources(tables_in(tree, "source"), groups, folder);
    experiment.detectors = read_detectors(tables_in(tree, "detector"), groups);
    experiment.media = media.media();

    if (experiment.objects.empty() && !experiment.picture->camera)
        need_sources(experiment);
    check_names(experiment);
    std::vector<double> const wavelengths = all_wavelengths(experiment.sources);
    experiment.warnings = check_media(media, wavelengths);
    warn_of_metals(experiment, tree.find("surface"), wavelengths);
    experiment.sweep = read_sweep(tree);
    experiment.goal = read_goal(tree);
    check_steps(tree, experiment);
    return experiment;
}

} // namespace sahl

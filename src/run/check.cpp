#include "run/check.h"

#include "run/check_report.h"
#include "run/check_words.h"
#include "run/mesh_fit.h"
#include "run/method_choice.h"
#include "run/pilots.h"
#include "run/values.h"
#include "scene/closeness.h"
#include "scene/read_model.h"

#include "math/input_error.h"

#include <algorithm>
#include <cctype>
#include <exception>

namespace sahl {

namespace {

/// The head of a report: what follows from the remarks.
Table head(std::string kind, std::string title, std::string file, Remarks const& remarks) {
    bool const unfit = !remarks.problems.empty();
    std::string const verdict = unfit ? "unfit" : remarks.warnings.empty() ? "fit" : "traced_but";
    return {{"kind", of(std::move(kind))},      {"title", of(std::move(title))},
            {"file", of(std::move(file))},      {"verdict", of(verdict)},
            {"problems", of(remarks.problems)}, {"warnings", of(remarks.warnings)},
            {"notes", of(remarks.notes)}};
}

/// Of the bodies of each object that is a model, taken together.
void doubt_units(Experiment const& experiment, Scene const& scene, Remarks& remarks) {
    for (ObjectSpec const& object : experiment.objects) {
        auto const* const model = std::get_if<ModelReference>(&object.what);
        if (!model)
            continue;
        double size = 0.0;
        for (Body const& body : scene.bodies)
            if (body.mesh && (body.name == object.name || body.name.starts_with(object.name + ".")))
                for (int axis = 0; axis < 3; ++axis)
                    size = std::max(size, length(body.to_world.linear[axis]) *
                                              (body.mesh->high - body.mesh->low)[axis]);
        if (std::string const doubt = unit_doubt(size, model->metres_per_unit); !doubt.empty())
            remarks.warnings.push_back(object.name + ": " + doubt);
    }
}

/// An experiment of a model and nothing else.
Experiment lone_model(std::filesystem::path const& file, double metres_per_unit) {
    Experiment experiment;
    experiment.file = file;
    experiment.media.push_back({"air", ConstantIndex{1.0}, {}, {}});
    experiment.surroundings = {0};
    std::string name = file.stem().string();
    std::replace(name.begin(), name.end(), '.', '_');
    Place const place{file.string(), 0, 0, {}};
    experiment.objects.push_back(
        {name, ModelReference{file, metres_per_unit, {}, {}, place}, {}, {}, {}, {}, 0, place});
    return experiment;
}

/// The scene of the lone model; where the file does not say what it is made of, it gets a medium.
Scene build(Experiment& experiment, Remarks& remarks) {
    try {
        return build_scene(experiment);
    } catch (InputError const&) {
        std::exception_ptr const of_the_file = std::current_exception();
        experiment.media.push_back({"a medium yet to be given", ConstantIndex{1.5}, {}, {}});
        experiment.objects.front().medium = MediumId{1};
        try {
            Scene scene = build_scene(experiment);
            remarks.notes.emplace_back(
                "the file does not say what everything in it is made of: give the object "
                "a medium or a surface in the experiment");
            return scene;
        } catch (InputError const&) {
            std::rethrow_exception(of_the_file);
        }
    }
}

Value fit_of_lone_model(Scene& scene, double tolerance) {
    scene.sources = probing_beams(scene);
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, 1);
    TraceOptions options;
    options.tolerance = tolerance;
    options.max_depth = 2; // in and out
    return mesh_fits(scene, optics, emission, options);
}

} // namespace

Value check_experiment(ExperimentSource const& source, bool fit) {
    Experiment const experiment = read_experiment(source.tree, source.file);
    Scene scene = build_scene(experiment);
    path_filters(scene, experiment.log.where); // refuses a wrong one
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, experiment.trace.seed);
    Census const census = take_census(scene, optics, emission, experiment.trace);
    Checked const checked{scene, optics, emission, census};

    Remarks remarks = census_remarks(checked, experiment.limits.leak, !experiment.sweep.empty());
    remarks.warnings.insert(remarks.warnings.begin(), scene.warnings.begin(), scene.warnings.end());
    doubt_units(experiment, scene, remarks);
    auto const& wavelengths = optics.wavelengths();
    if (auto const longest = std::max_element(wavelengths.begin(), wavelengths.end());
        longest != wavelengths.end())
        for (std::string& warning : near_warnings(scene, *longest))
            remarks.warnings.push_back(std::move(warning));
    Value fits = fit ? mesh_fits(scene, optics, emission, experiment.trace) : nothing();
    bool const fewer = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                   [](Body const& body) { return body.decimate > 0.0; });
    if (fewer || experiment.trace.decimate)
        for (std::string& warning : settle_methods(scene, optics, emission, experiment.trace).warnings)
            remarks.warnings.push_back(std::move(warning));
    Pilots const pilots = send_pilots(scene, optics, emission, experiment.trace);
    if (pilots.polarisation)
        for (std::string& warning :
             polarisation_warnings(*pilots.polarisation, experiment.trace.tolerance_power))
            remarks.warnings.push_back(std::move(warning));
    for (std::string& note : dispersion_notes(pilots.dispersion, experiment.trace.tolerance))
        remarks.notes.push_back(std::move(note));
    Value models = models_value(scene, true, &remarks);
    Table report = head("experiment", experiment.title, source.file.string(), remarks);
    report.emplace_back("objects", objects_value(checked));
    report.emplace_back("sources", sources_value(checked));
    report.emplace_back("detectors", detectors_value(checked));
    report.emplace_back("contacts", contacts_value(scene));
    report.emplace_back("media", media_value(checked));
    report.emplace_back("models", std::move(models));
    report.emplace_back("pilots", pilots_value(pilots));
    if (fit)
        report.emplace_back("fit", std::move(fits));
    return of(std::move(report));
}

CheckedModel look_at_model(std::filesystem::path const& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    bool const unit_known = ending != ".obj";
    double const unit = unit_known ? 1.0 : 1e-3;
    Remarks remarks;
    Experiment experiment = lone_model(file, unit);
    Scene scene = build(experiment, remarks);
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, 1);
    Census const census = take_census(scene, optics, emission, {});
    Checked const checked{scene, optics, emission, census};
    if (!unit_known)
        remarks.notes.emplace_back("the format has no unit; lengths here are as if it were in millimetres");
    doubt_units(experiment, scene, remarks);
    remarks.warnings.insert(remarks.warnings.end(), scene.warnings.begin(), scene.warnings.end());
    Value models = models_value(scene, true, &remarks);
    Table report = head("model", "", file.string(), remarks);
    report.emplace_back("length_unit", of(std::string(unit_known ? "m" : "unknown, taken as mm")));
    report.emplace_back("objects", objects_value(checked));
    report.emplace_back("contacts", contacts_value(scene));
    report.emplace_back("models", std::move(models));
    return {std::move(scene), of(std::move(report))};
}

Value check_model(std::filesystem::path const& file, std::optional<double> fit) {
    CheckedModel checked = look_at_model(file);
    if (fit)
        std::get<Table>(checked.report.data).emplace_back("fit", fit_of_lone_model(checked.scene, *fit));
    return std::move(checked.report);
}

} // namespace sahl

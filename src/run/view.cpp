#include "run/view.h"

#include "math/input_error.h"
#include "run/check.h"
#include "run/model_marks.h"
#include "run/one_run.h"
#include "run/sweep.h"
#include "run/values.h"
#include "scene/read_file.h"

namespace sahl {

namespace fs = std::filesystem;

namespace {

/// What `sahl chart` measured into this folder, if it did.
std::optional<Value> methods_in(fs::path const& folder) {
    fs::path const file = folder / "chart.json";
    return fs::exists(file) ? std::optional(parse_json(file_text(file), file.string())) : std::nullopt;
}

std::vector<std::string> settings_of(Value const& summary) {
    std::vector<std::string> settings;
    Value const* const options = summary.find("options");
    Value const* const set = options ? options->find("set") : nullptr;
    if (auto const* list = set ? std::get_if<Array>(&set->data) : nullptr)
        for (Value const& assignment : *list)
            if (auto const* text = std::get_if<std::string>(&assignment.data))
                settings.push_back(*text);
    if (Value const* const goal = summary.find("goal"))
        if (auto const* key = goal->find("key"); key && goal->find("at"))
            settings.push_back(std::get<std::string>(key->data) + "=" + to_json(*goal->find("at")));
    return settings;
}

void from_experiment(fs::path const& folder, fs::path const& file) {
    fs::path const summary_file = folder / "summary.json";
    Value summary = parse_json(file_text(summary_file), summary_file.string());
    ExperimentSource const source = load_experiment(file, settings_of(summary));
    Value const* const hash = summary.find("experiment_sha256");
    auto const* text = hash ? std::get_if<std::string>(&hash->data) : nullptr;
    if (text && *text != experiment_sha256(source))
        throw InputError(file.string(), "is not the experiment of the run in " + folder.string(),
                         "give the file that the run was made of, unchanged");
    if (summary.find("sweep")) {
        write_sweep_page(source, folder, summary);
        return;
    }
    OneRun const run =
        drawn_again(source, read_experiment(source.tree, source.file), std::move(summary), folder, nullptr);
    write_page(folder, run, run.summary, {}, {});
}

} // namespace

fs::path view_run(fs::path const& folder, std::optional<fs::path> const& experiment) {
    fs::path const page = folder / "report.html";
    if (!fs::exists(folder / "summary.json"))
        throw InputError(folder.string(), "is no folder of a run: it has no summary.json",
                         "give one that sahl trace wrote, or a model");
    std::optional<Value> const methods = methods_in(folder);
    if (experiment)
        from_experiment(folder, *experiment);
    auto const renewed =
        fs::exists(page) ? renewed_page(file_text(page), methods ? &*methods : nullptr) : std::nullopt;
    if (!renewed)
        throw InputError(folder.string(), "has no page with the run's data",
                         "give the experiment of this run: --experiment FILE");
    write_text(page, *renewed);
    return page;
}

fs::path view_model(fs::path const& model, fs::path const& out) {
    CheckedModel const checked = look_at_model(model);
    PageInput input{checked.report, checked.scene, {}, {}, {}, {}, {}, {}};
    for (Face const& face : checked.scene.faces)
        input.names.surfaces.push_back(face.name);
    for (Medium const& medium : checked.scene.media)
        input.names.media.push_back(medium.name);
    input.marks = model_marks(model, checked.scene);
    input.is_model = true;
    fs::create_directories(out);
    write_text(out / "report.html", report_page(input));
    return out / "report.html";
}

} // namespace sahl

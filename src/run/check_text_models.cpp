// In: the health of a report's meshes. Out: the same for a person.
#include "run/check_page.h"
#include "run/check_words.h"

#include <map>

namespace sahl {

namespace {

std::string normals_words(Value const& model) {
    Value const& normals = *model.find("normals");
    std::string const kind = string_at(normals, "kind");
    if (kind == "none")
        return "none in the file: its triangles are flat";
    if (kind == "any_mean" && number_at(normals, "worst_deg") < 1e-3)
        return "those of the geometry";
    std::string const made = kind == "flat"             ? "those of the flat triangles"
                             : kind == "max_weighted"   ? "exact on spheres (by Max's weights)"
                             : kind == "area_weighted"  ? "means weighted by area"
                             : kind == "angle_weighted" ? "means weighted by angle"
                             : kind == "plain_mean"     ? "plain means"
                             : kind == "any_mean"       ? "means of the triangles' normals"
                                                        : "the file's own";
    return made + words("; %.3g° RMS, %.3g° at worst from the geometry", number_at(normals, "rms_deg"),
                        number_at(normals, "worst_deg"));
}

std::string shells_words(Value const& model) {
    std::size_t bodies = 0, cavities = 0, open = 0;
    for (Value const& shell : list_at(model, "shells")) {
        std::string const kind = string_at(shell, "kind");
        ++(kind == "body" ? bodies : kind == "cavity" ? cavities : open);
    }
    if (auto const count = count_at(model, "shell_count"); count > bodies + cavities + open)
        return plural(count, "shell", "shells");
    std::string text;
    auto const add = [&](std::size_t count, char const* one, char const* many) {
        if (count)
            text += (text.empty() ? "" : ", ") + plural(count, one, many);
    };
    add(bodies, "closed shell", "closed shells");
    add(cavities, "cavity", "cavities");
    add(open, "open piece", "open pieces");
    return text;
}

std::string model_lines(std::string const& name, Value const& model, std::size_t others) {
    Value const& borders = *model.find("borders");
    std::string text = "  " + name;
    if (others > 0)
        text += ", and " + std::to_string(others) + " more of the same mesh (sizes are of the first)";
    text += "\n";
    auto const line = [&](std::string const& what) { text += wrapped(what, "    ", "      "); };
    line(joined(list_at(model, "size_mm"), " × ", "%.6g") + " mm, " +
         plural(count_at(model, "triangles"), "triangle", "triangles") + ", " +
         plural(count_at(model, "vertices"), "vertex", "vertices") + "; " + shells_words(model));
    if (is_true(model, "closed"))
        line(words("closed: true, volume %.6g mm³, area %.6g mm²", number_at(model, "volume_mm3"),
                   number_at(model, "area_mm2")));
    else
        line(words("closed: false, area %.6g mm², ", number_at(model, "area_mm2")) +
             plural(count_at(borders, "count"), "border", "borders") +
             words(" of %.4g mm in all, ", number_at(borders, "length_mm")) +
             plural(count_at(*model.find("non_manifold_edges"), "count"), "edge", "edges") +
             " of more than two triangles");
    for (Value const& border : list_at(borders, "longest"))
        line("border of " +
             words("%.4g mm (%.0f edges) round (", number_at(border, "length_mm"),
                   number_at(border, "edges")) +
             joined(list_at(border, "centre_mm"), ", ", "%.6g") + ") mm");
    Value const& creases = *model.find("creases");
    line("creases: " + (count_at(creases, "count")
                            ? plural(count_at(creases, "count"), "edge", "edges") +
                                  words(" sharper than 30°, %.4g mm in all", number_at(creases, "length_mm"))
                            : std::string("none")));
    line("normals: " + normals_words(model));
    if (std::holds_alternative<std::monostate>(model.find("self_intersections")->data))
        line("self-intersection: not looked for, the mesh is too large");
    return text;
}

} // namespace

std::string models_text(Table const& models) {
    std::map<std::string, std::size_t> others;
    for (auto const& [name, model] : models)
        if (std::string const like = string_at(model, "same_mesh_as"); !like.empty())
            ++others[like];
    std::string text;
    std::size_t told = 0;
    for (auto const& [name, model] : models)
        if (string_at(model, "same_mesh_as").empty() && told++ < shown_at_once)
            text += model_lines(name, model, others[name]);
    if (told > shown_at_once)
        text += "  … and " + std::to_string(told - shown_at_once) + " more: see --json\n";
    return text.empty() ? "" : "\nmeshes\n" + text;
}

} // namespace sahl

// In: a check's report. Out: the same for a person: the verdict first, then the parts.
#include "run/check.h"

#include "run/check_words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace sahl {

namespace {

constexpr std::size_t shown = 20; // of objects, meshes, remarks: a page, not a listing; --json has all

std::string string_at(Value const& table, char const* key) {
    Value const* const found = table.find(key);
    auto const* const text = found ? std::get_if<std::string>(&found->data) : nullptr;
    return text ? *text : "";
}

double number_of(Value const& value) {
    if (auto const* const whole = std::get_if<std::int64_t>(&value.data))
        return static_cast<double>(*whole);
    auto const* const number = std::get_if<double>(&value.data);
    return number ? *number : 0.0;
}

double number_at(Value const& table, char const* key) {
    Value const* const found = table.find(key);
    return found ? number_of(*found) : 0.0;
}

std::uint64_t count_at(Value const& table, char const* key) {
    return static_cast<std::uint64_t>(number_at(table, key));
}

bool is_true(Value const& table, char const* key) {
    Value const* const found = table.find(key);
    auto const* const flag = found ? std::get_if<bool>(&found->data) : nullptr;
    return flag && *flag;
}

Table const& table_at(Value const& table, char const* key) {
    static Table const none;
    Value const* const found = table.find(key);
    auto const* const entries = found ? std::get_if<Table>(&found->data) : nullptr;
    return entries ? *entries : none;
}

Array const& list_at(Value const& table, char const* key) {
    static Array const none;
    Value const* const found = table.find(key);
    auto const* const entries = found ? std::get_if<Array>(&found->data) : nullptr;
    return entries ? *entries : none;
}

std::string joined(Array const& numbers, char const* between, char const* format) {
    std::string text;
    for (Value const& number : numbers) {
        char digits[40];
        std::snprintf(digits, sizeof digits, format, number_of(number));
        text += (text.empty() ? "" : between) + std::string(digits);
    }
    return text;
}

/// Breaks at blanks so that no line is longer than a terminal's; those after the first are indented.
std::string wrapped(std::string const& text, std::string const& first, std::string const& margin) {
    constexpr std::size_t width = 100;
    std::string out = first, line;
    std::size_t used = first.size();
    for (std::size_t begin = 0; begin < text.size();) {
        std::size_t const end = std::min(text.find(' ', begin), text.size());
        std::string const word = text.substr(begin, end - begin);
        if (used + word.size() > width && used > margin.size()) {
            out += "\n" + margin;
            used = margin.size();
        } else if (begin > 0) {
            out += " ";
            ++used;
        }
        out += word;
        used += word.size();
        begin = end + 1;
    }
    return out + "\n";
}

std::string remarks(Array const& list, char const* title) {
    if (list.empty())
        return "";
    std::string text = std::string(title) + "\n";
    for (std::size_t i = 0; i < std::min(shown, list.size()); ++i)
        text += wrapped(std::get<std::string>(list[i].data), "  - ", "    ");
    if (list.size() > shown)
        text += "  … and " + std::to_string(list.size() - shown) + " more: see --json\n";
    return text;
}

std::string verdict(Value const& report) {
    std::string const verdict = string_at(report, "verdict");
    std::size_t const problems = list_at(report, "problems").size(),
                      warnings = list_at(report, "warnings").size();
    std::string text = verdict == "fit" ? "fit to trace\n"
                       : verdict == "unfit"
                           ? "not fit to trace: " + plural(problems, "problem", "problems") + "\n"
                           : "traced, but " + plural(warnings, "thing", "things") + " may not be as meant\n";
    text += remarks(list_at(report, "problems"), "problems");
    text += remarks(list_at(report, "warnings"), "warnings");
    text += remarks(list_at(report, "notes"), "notes");
    return text;
}

template <class Line>
std::string section(char const* title, Table const& entries, Line const& line) {
    if (entries.empty())
        return "";
    std::string text = "\n" + std::string(title) + "\n";
    for (std::size_t i = 0; i < std::min(shown, entries.size()); ++i)
        text += wrapped(line(entries[i].second), "  " + entries[i].first + ": ", "    ");
    if (entries.size() > shown)
        text += "  … and " + std::to_string(entries.size() - shown) + " more: see --json\n";
    return text;
}

std::string object_line(Value const& object) {
    std::string line = string_at(object, "what");
    if (string_at(object, "shape") == "mesh")
        line += words(", mesh of %.0f triangles, ", number_at(object, "triangles")) +
                joined(list_at(object, "size_mm"), " × ", "%.6g") + " mm at (" +
                joined(list_at(object, "centre_mm"), ", ", "%.6g") + ") mm";
    else
        line += ", exact " + string_at(object, "shape") + " at (" +
                joined(list_at(object, "origin_mm"), ", ", "%.6g") + ") mm";
    if (is_true(object, "mirrored"))
        line += ", mirrored";
    return line;
}

std::string source_line(Value const& source) {
    std::string line = plural(count_at(source, "rays"), "ray", "rays") + " of " +
                       plural(list_at(source, "wavelengths_nm").size(), "wavelength", "wavelengths") +
                       ", starts ";
    std::string places;
    for (Value const& start : list_at(source, "starts")) {
        std::string on;
        for (Value const& body : list_at(start, "on_the_surface_of"))
            on += (on.empty() ? ", on the surface of " : " and ") + std::get<std::string>(body.data);
        std::string const in = string_at(start, "in");
        places += (places.empty() ? "in " : "; also in ") + std::string(in == "surroundings" ? "the " : "") +
                  in + " (" + string_at(start, "medium") + ")" + on;
    }
    return line + places +
           words("; %.0f of %.0f pilot rays meet something",
                 number_at(source, "pilot_rays_that_meet_something"), number_at(source, "pilot_rays"));
}

std::string detector_line(Value const& detector) {
    std::string line = joined(list_at(detector, "size_mm"), " × ", "%.6g") + " mm, " +
                       joined(list_at(detector, "pixels"), " × ", "%.0f") + " pixels, " +
                       plural(count_at(detector, "pilot_hits"), "pilot hit", "pilot hits");
    if (auto const behind = count_at(detector, "pilot_hits_from_behind"))
        line += ", " + std::to_string(behind) + " from behind";
    return line;
}

std::string medium_line(Value const& indices) {
    std::string line;
    for (auto const& [wavelength, n] : std::get<Table>(indices.data))
        line += words("%sn = %.6f at %s", line.empty() ? "" : ", ", number_of(n), wavelength.c_str());
    return line;
}

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

std::string models_text(Table const& models) {
    std::map<std::string, std::size_t> others;
    for (auto const& [name, model] : models)
        if (std::string const like = string_at(model, "same_mesh_as"); !like.empty())
            ++others[like];
    std::string text;
    std::size_t told = 0;
    for (auto const& [name, model] : models)
        if (string_at(model, "same_mesh_as").empty() && told++ < shown)
            text += model_lines(name, model, others[name]);
    if (told > shown)
        text += "  … and " + std::to_string(told - shown) + " more: see --json\n";
    return text.empty() ? "" : "\nmeshes\n" + text;
}

} // namespace

std::string check_text(Value const& report) {
    std::string const title = string_at(report, "title"), file = string_at(report, "file");
    std::string text = (title.empty() ? file : title + " (" + file + ")") + "\n" + verdict(report);
    text += section("objects", table_at(report, "objects"), object_line);
    text += section("sources", table_at(report, "sources"), source_line);
    text += section("detectors", table_at(report, "detectors"), detector_line);
    if (Array const& contacts = list_at(report, "contacts"); !contacts.empty())
        text += "\n" + remarks(contacts, "contacts");
    text += section("media", table_at(report, "media"), medium_line);
    return text + models_text(table_at(report, "models"));
}

} // namespace sahl

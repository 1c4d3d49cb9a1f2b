// In: a check's report. Out: the same for a person: the verdict first, then the parts.
#include "run/check.h"

#include "run/check_page.h"
#include "run/check_words.h"
#include "run/mesh_fit.h"

#include <algorithm>

namespace sahl {

namespace {

std::string remarks(Array const& list, char const* title) {
    if (list.empty())
        return "";
    std::string text = std::string(title) + "\n";
    for (std::size_t i = 0; i < std::min(shown_at_once, list.size()); ++i)
        text += wrapped(std::get<std::string>(list[i].data), "  - ", "    ");
    if (list.size() > shown_at_once)
        text += "  … and " + std::to_string(list.size() - shown_at_once) + " more: see --json\n";
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
    for (std::size_t i = 0; i < std::min(shown_at_once, entries.size()); ++i)
        text += wrapped(line(entries[i].second), "  " + entries[i].first + ": ", "    ");
    if (entries.size() > shown_at_once)
        text += "  … and " + std::to_string(entries.size() - shown_at_once) + " more: see --json\n";
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
    Value const* const surface = detector.find("surface");
    std::string const what = detector.find("sphere") ? "what leaves the scene, "
                             : surface ? "what arrives at " + std::get<std::string>(surface->data) + ", "
                                       : joined(list_at(detector, "size_mm"), " × ", "%.6g") + " mm, " +
                                             joined(list_at(detector, "pixels"), " × ", "%.0f") + " pixels, ";
    std::string line = what + plural(count_at(detector, "pilot_hits"), "pilot hit", "pilot hits");
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
    text += models_text(table_at(report, "models"));
    Value const* const fit = report.find("fit");
    return fit ? text + fits_text(*fit) : text;
}

} // namespace sahl

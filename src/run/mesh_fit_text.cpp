// In: what fineness meshes carry. Out: the same for a person.
#include "run/check_page.h"
#include "run/check_words.h"
#include "run/mesh_fit.h"

#include <cmath>

namespace sahl {

namespace {

std::string normals_words(Value const& mesh) {
    std::string const use = string_at(mesh, "normals");
    if (use == "none")
        return "the file has no normals: places alone are used";
    if (use == "flat")
        return "the file's normals are those of the triangles: places alone are used";
    std::string const figures = words("%.2g rad from the places' (median), which can tell %.2g",
                                      number_at(mesh, "normals_off_rad"), number_at(mesh, "places_tell_rad"));
    return use == "used" ? "the file's normals are used: " + figures
                         : "the file's normals are first order only, or of few digits: " + figures +
                               ". quadratic and fitted take the places alone";
}

/// Two digits: it is an estimate.
std::string estimate(double triangles) {
    double const unit = std::pow(10.0, std::floor(std::log10(std::max(triangles, 10.0))) - 1.0);
    return words("%.0f", std::ceil(triangles / unit) * unit);
}

std::string level_line(Value const& level) {
    Value const& needed = *level.find("triangles_for_tolerance");
    return words("    %-13s %9.2g %9.2g %7.2g%%   %s\n", string_at(level, "method").c_str(),
                 number_at(level, "bound_rad"), number_at(level, "rms_rad"),
                 100.0 * number_at(level, "sequence_changed"),
                 std::holds_alternative<double>(needed.data) ? estimate(std::get<double>(needed.data)).c_str()
                                                             : "-");
}

std::string fit_lines(std::string const& name, Value const& mesh, double share) {
    std::string text =
        wrapped(plural(count_at(mesh, "triangles"), "triangle", "triangles") +
                    words(", places in steps of %.2g mm; ", number_at(mesh, "step_mm")) + normals_words(mesh),
                "  " + name + ": ", "    ");
    if (double const instead = number_at(mesh, "quadratic_instead"); instead > 0.0)
        text +=
            wrapped(words("fitted takes the quadratic surface over %.2g%% of the triangles, where it would "
                          "stray",
                          100.0 * instead),
                    "    ", "      ");
    if (is_true(mesh, "loses_light"))
        return text + wrapped("the curved surface through them loses light, as that of a rough scan does: "
                              "nothing but the triangles is known",
                              "    ", "      ");
    text += wrapped(words("its digits leave %.2g rad open (RMS)", number_at(mesh, "floor_rad")), "    ",
                    "      ");
    text +=
        words("    %-13s %9s %9s %8s   %s\n", "method", "bound", "RMS", "other", "triangles that would do");
    for (Value const& level : list_at(mesh, "levels"))
        text += level_line(level);
    std::string const fastest = string_at(mesh, "fastest_within");
    return text + "    " +
           (fastest.empty() ? words("no method is within %.3g rad\n", share)
                            : "the fastest within " + words("%.3g rad: ", share) + fastest + "\n");
}

} // namespace

std::string fits_text(Value const& fits) {
    std::string text;
    Table const& models = table_at(fits, "models");
    if (models.empty())
        return "\nfineness: no closed mesh that light meets\n";
    for (auto const& [name, mesh] : models)
        text += fit_lines(name, mesh, number_at(fits, "share_rad"));
    return words("\nfineness for a tolerance of %.3g rad\n", number_at(fits, "tolerance_rad")) + text;
}

} // namespace sahl

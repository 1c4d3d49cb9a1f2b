// In: a question to the catalogue. Out: what answers it, as a tree.
#include "run/glass_report.h"

#include "materials/catalogue.h"
#include "math/input_error.h"
#include "run/values.h"
#include "scene/model_parts.h"
#include "scene/read_catalogues.h"
#include "scene/read_table.h"

#include <algorithm>
#include <cmath>

namespace sahl {
namespace {

// m, in standard air: hydrogen F, helium d, hydrogen C, of which n_d and V_d are made (ISO 7944).
constexpr double line_f = 486.1327e-9, line_d = 587.5618e-9, line_c = 656.2725e-9;

double abbe_number(Medium const& medium) {
    auto const n = [&](double wavelength) { return refractive_index(medium.index, wavelength); };
    return (n(line_d) - 1.0) / (n(line_f) - n(line_c));
}

/// Share of the power that a plate of this index lets through at normal incidence, reflections to and fro
/// within it included: T = (1 − R)² t/(1 − R² t²), R = ((n − 1)/(n + 1))², t the transmittance of its inside.
double plate_transmittance(double n, double internal) {
    double const r = (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0));
    return (1.0 - r) * (1.0 - r) * internal / (1.0 - r * r * internal * internal);
}

Value printed(double figure) {
    return figure == 0.0 ? nothing() : of(figure);
}

Value range_nm(double from, double to) {
    auto const nm = [](double metres) { return of(std::round(metres * 1e13) / 1e4); };
    return of(Array{nm(from), nm(to)});
}

Value glass_value(GlassEntry const& entry, GlassQuestion const& question) {
    Medium const& medium = entry.medium;
    double const n = refractive_index(medium.index, question.wavelength_nm * 1e-9);
    auto const [from, to] = medium.range;
    bool const has_range = to > 0.0, absorbs = !medium.absorption.empty();
    double const alpha = absorption_coefficient(medium, question.wavelength_nm * 1e-9);
    double const internal = std::exp(-alpha * question.thickness_mm * 1e-3);
    Array coefficients;
    for (double const c : entry.coefficients)
        coefficients.push_back(of(c));
    return of(Table{
        {"name", of(entry.name)},
        {"maker", of(entry.maker)},
        {"full_name", of(entry.full_name())},
        {"n", of(n)},
        {"nd", of(refractive_index(medium.index, line_d))},
        {"vd", of(disperses(medium.index) ? abbe_number(medium) : std::nan(""))},
        {"printed_nd", printed(entry.nd)},
        {"printed_vd", printed(entry.vd)},
        {"formula", of(entry.formula)},
        {"coefficients", of(std::move(coefficients))},
        {"range_nm", has_range ? range_nm(from, to) : nothing()},
        {"in_range",
         of(!has_range || (question.wavelength_nm * 1e-9 >= from && question.wavelength_nm * 1e-9 <= to))},
        {"absorption_range_nm",
         absorbs ? range_nm(medium.absorption.front().first, medium.absorption.back().first) : nothing()},
        {"absorption_per_mm", absorbs ? of(alpha * 1e-3) : nothing()},
        {"internal_transmittance", absorbs ? of(internal) : nothing()},
        {"plate_transmittance", absorbs ? of(plate_transmittance(n, internal)) : nothing()}});
}

Value metal_value(std::string const& name, GlassQuestion const& question) {
    Metal const metal = *find_metal(name);
    auto const index = complex_index(metal, question.wavelength_nm * 1e-9);
    double const from = metal.table.front().wavelength, to = metal.table.back().wavelength;
    return of(Table{
        {"name", of(name)},
        {"n", of(index.real())},
        {"k", of(index.imag())},
        {"reflectance", of(std::norm((index - 1.0) / (index + 1.0)))},
        {"range_nm", range_nm(from, to)},
        {"in_range", of(question.wavelength_nm * 1e-9 >= from && question.wavelength_nm * 1e-9 <= to)}});
}

std::string lower(std::string text) {
    for (char& c : text)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

/// Does a name, or a part of one, or a pattern, mean this glass or metal?
bool means(std::string const& word, std::string const& name, std::string const& full_name) {
    if (word.find_first_of("*?") == word.npos)
        return lower(full_name).find(lower(word)) != std::string::npos;
    return matches(lower(word), lower(name)) || matches(lower(word), lower(full_name));
}

using Entries = std::vector<GlassEntry const*>;

/// Exactly this name, if there is one, else all that it may mean.
Entries wanted_glasses(std::vector<GlassEntry> const& catalogue, std::string const& name) {
    Entries found = glasses_called(catalogue, name);
    if (found.empty())
        for (GlassEntry const& entry : catalogue)
            if (means(name, entry.name, entry.full_name()))
                found.push_back(&entry);
    return found;
}

/// How far a glass is from what is asked for: 0.01 of n_d weighs as much as 1 of V_d, about what neighbours
/// in a glass map differ by. Infinite where it has no such figure.
double distance(GlassEntry const& entry, GlassQuestion const& question) {
    double const nd = refractive_index(entry.medium.index, line_d), vd = abbe_number(entry.medium);
    double const far =
        std::hypot(question.nd ? (nd - *question.nd) / 0.01 : 0.0, question.vd ? vd - *question.vd : 0.0);
    return std::isfinite(far) && disperses(entry.medium.index) ? far : HUGE_VAL;
}

void keep_nearest(Entries& entries, GlassQuestion const& question) {
    std::vector<std::pair<double, GlassEntry const*>> ranked;
    for (GlassEntry const* const entry : entries)
        ranked.emplace_back(distance(*entry, question), entry);
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](auto const& a, auto const& b) { return a.first < b.first; });
    ranked.resize(std::min(ranked.size(), question.most));
    entries.clear();
    for (auto const& [far, entry] : ranked)
        entries.push_back(entry);
}

std::vector<std::string> wanted_metals(std::string const& name, bool glass_has_the_name) {
    std::vector<std::string> found;
    for (std::string const& metal : metal_names())
        if (lower(metal) == lower(name) || (!glass_has_the_name && means(name, metal, metal)))
            found.push_back(metal);
    return found;
}

} // namespace

Value glass_report(GlassQuestion const& question) {
    std::vector<GlassEntry> catalogue;
    for (auto const& path : question.catalogues) {
        auto own = read_catalogue_file(path);
        std::move(own.begin(), own.end(), std::back_inserter(catalogue));
    }
    std::vector<GlassEntry> const own = catalogue;
    catalogue.insert(catalogue.end(), glass_catalogue().begin(), glass_catalogue().end());

    Entries entries = wanted_glasses(catalogue, question.name);
    bool const by_figures = question.nd || question.vd;
    std::vector<std::string> metals;
    if (!by_figures)
        metals = wanted_metals(question.name, !glasses_called(catalogue, question.name).empty());
    if (std::any_of(metals.begin(), metals.end(),
                    [&](std::string const& metal) { return lower(metal) == lower(question.name); }))
        entries.clear();
    if (entries.empty() && metals.empty())
        throw InputError("catalogue", "there is no glass or metal \"" + question.name + "\"",
                         similar_entries(own, question.name));
    if (by_figures)
        keep_nearest(entries, question);

    Array glass_list, metal_list;
    for (GlassEntry const* const entry : entries)
        glass_list.push_back(glass_value(*entry, question));
    for (std::string const& metal : metals)
        metal_list.push_back(metal_value(metal, question));
    return of(Table{{"at_nm", of(question.wavelength_nm)},
                    {"thickness_mm", of(question.thickness_mm)},
                    {"everything", of(question.name.empty() && !by_figures)},
                    {"glasses", of(std::move(glass_list))},
                    {"metals", of(std::move(metal_list))}});
}

} // namespace sahl

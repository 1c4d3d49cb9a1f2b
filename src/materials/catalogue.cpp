// In: a name. Out: what catalogues have under it, or something like it. Rows become media here.
#include "materials/catalogue.h"

#include "materials/catalogue_data.h"
#include "materials/formulas.h"
#include "math/nearest_name.h"

#include <algorithm>
#include <cassert>

namespace sahl {
namespace {

constexpr double um_to_metres = 1e-6;
constexpr double pi = 3.14159265358979323846;

Dispersion dispersion_of(GlassRow const& row) {
    auto const formula = page_formula(row.formula, row.coefficients);
    assert(formula);
    return row.absolute ? AbsoluteIndex{std::make_shared<AnyDispersion const>(AnyDispersion{*formula})}
                        : *formula;
}

GlassEntry entry_of(GlassRow const& row) {
    GlassEntry entry{row.maker, row.name, {}, row.nd, row.vd, {}, {}};
    entry.medium = {row.name, dispersion_of(row), {}, {row.from_um * um_to_metres, row.to_um * um_to_metres}};
    for (std::size_t i = 0; i < row.um.size(); ++i)
        entry.medium.absorption.emplace_back(row.um[i] * um_to_metres,
                                             4 * pi * row.k[i] / (row.um[i] * um_to_metres));
    entry.formula = "formula " + std::to_string(row.formula);
    entry.coefficients.assign(row.coefficients.begin(), row.coefficients.end());
    return entry;
}

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        c = lower(c);
    return result;
}

bool same_name(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower(x) == lower(y); });
}

} // namespace

std::vector<GlassEntry> const& glass_catalogue() {
    static std::vector<GlassEntry> const entries = [] {
        std::vector<GlassEntry> list;
        list.push_back({"other", "air", Medium{"air", ConstantIndex{1.0}, {}, {}}, 0, 0, "1 exactly", {}});
        list.push_back({"other", "vacuum", Medium{"vacuum", VacuumIndex{}, {}, {}}, 0, 0, "1/n_air", {}});
        for (GlassRow const& row : glass_rows())
            list.push_back(entry_of(row));
        return list;
    }();
    return entries;
}

std::vector<GlassEntry const*> glasses_called(std::span<GlassEntry const> catalogue, std::string_view name) {
    std::vector<GlassEntry const*> found;
    for (GlassEntry const& entry : catalogue)
        if (same_name(name, entry.name) || same_name(name, entry.full_name()))
            found.push_back(&entry);
    return found;
}

std::vector<std::string> similar_glasses(std::span<GlassEntry const> catalogue, std::string_view name,
                                         std::size_t most) {
    std::string const word = lower(name);
    std::vector<std::pair<std::size_t, std::string>> ranked;
    for (GlassEntry const& entry : catalogue) {
        std::string const bare = lower(entry.name), full = lower(entry.full_name());
        std::size_t const far = std::min(edit_distance(word, bare), edit_distance(word, full));
        bool const part = !word.empty() && full.find(word) != full.npos;
        ranked.emplace_back(part ? 0 : far, entry.full_name());
    }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](auto const& a, auto const& b) { return a.first < b.first; });
    std::vector<std::string> names;
    // What is farther than the nearest, or than half of the word, was hardly meant.
    for (auto const& [far, full] : ranked)
        if (names.size() < most && (far <= ranked.front().first || 2 * far <= word.size()))
            names.push_back(full);
    return names;
}

std::optional<Medium> find_glass(std::string_view name) {
    auto const found = glasses_called(glass_catalogue(), name);
    return found.size() == 1 ? std::optional(found.front()->medium) : std::nullopt;
}

std::optional<Metal> find_metal(std::string_view name) {
    for (MetalRow const& row : metal_rows()) {
        if (!same_name(name, row.name))
            continue;
        Metal metal;
        for (std::size_t i = 0; i < row.um.size(); ++i)
            metal.table.push_back({row.um[i] * um_to_metres, row.n[i], row.k[i]});
        return metal;
    }
    return std::nullopt;
}

std::vector<std::string> metal_names() {
    std::vector<std::string> names;
    for (MetalRow const& row : metal_rows())
        names.emplace_back(row.name);
    return names;
}

} // namespace sahl

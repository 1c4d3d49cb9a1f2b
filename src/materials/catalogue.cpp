// In: a name. Out: the medium or metal that the built-in catalogue has under it. Rows become media here.
#include "materials/catalogue.h"

#include "materials/catalogue_data.h"

#include <algorithm>
#include <cassert>

namespace sahl {
namespace {

constexpr double um_to_metres = 1e-6;
constexpr double pi = 3.14159265358979323846;

/// The dispersion formulas of the refractiveindex.info database, λ in µm, coefficients c1, c2 …:
///   1: n² − 1 = c1 + Σ c2 λ²/(λ² − c3²)     2: n² − 1 = c1 + Σ c2 λ²/(λ² − c3)     3: n² = c1 + Σ c2 λ^c3
Dispersion dispersion_of(GlassRow const& row) {
    auto const& c = row.coefficients;
    assert(row.formula >= 1 && row.formula <= 3 && c.size() % 2 == 1);
    if (row.formula == 3) {
        PowerSeries series{c[0], {}};
        for (std::size_t i = 1; i < c.size(); i += 2)
            series.terms.emplace_back(c[i], c[i + 1]);
        return series;
    }
    Sellmeier sellmeier{{}, {}, c[0]};
    for (std::size_t i = 1; i < c.size(); i += 2) {
        sellmeier.b.push_back(c[i]);
        sellmeier.c_um2.push_back(row.formula == 1 ? c[i + 1] * c[i + 1] : c[i + 1]);
    }
    return sellmeier;
}

GlassEntry entry_of(GlassRow const& row) {
    Medium medium{row.name, dispersion_of(row), {}, {row.from_um * um_to_metres, row.to_um * um_to_metres}};
    for (auto const& [um, k] : row.extinction)
        medium.absorption.emplace_back(um * um_to_metres, 4 * pi * k / (um * um_to_metres));
    return {row.maker, row.name, std::move(medium), row.nd, row.vd};
}

/// Equal but for the case of the letters a to z.
bool same_name(std::string_view a, std::string_view b) {
    auto const lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](char x, char y) { return lower(x) == lower(y); });
}

} // namespace

std::vector<GlassEntry> const& glass_catalogue() {
    static std::vector<GlassEntry> const entries = [] {
        std::vector<GlassEntry> list{{"other", "air", Medium{"air", ConstantIndex{1.0}, {}, {}}, 0.0, 0.0},
                                     {"other", "vacuum", Medium{"vacuum", VacuumIndex{}, {}, {}}, 0.0, 0.0}};
        for (GlassRow const& row : glass_rows())
            list.push_back(entry_of(row));
        return list;
    }();
    return entries;
}

std::optional<Medium> find_glass(std::string_view name) {
    for (GlassEntry const& entry : glass_catalogue())
        if (same_name(name, entry.name) || same_name(name, entry.maker + ":" + entry.name))
            return entry.medium;
    return std::nullopt;
}

std::optional<Metal> find_metal(std::string_view name) {
    for (MetalRow const& row : metal_rows()) {
        if (!same_name(name, row.name))
            continue;
        Metal metal;
        for (auto const& [um, n, k] : row.points)
            metal.table.push_back({um * um_to_metres, n, k});
        return metal;
    }
    return std::nullopt;
}

std::vector<std::string> glass_names() {
    std::vector<std::string> names;
    for (GlassEntry const& entry : glass_catalogue())
        names.push_back(entry.name);
    return names;
}

std::vector<std::string> metal_names() {
    std::vector<std::string> names;
    for (MetalRow const& row : metal_rows())
        names.emplace_back(row.name);
    return names;
}

} // namespace sahl

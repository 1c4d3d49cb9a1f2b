// In: the text of a Zemax AGF file. Out: its glasses.
#include "materials/catalogue_files.h"

#include "materials/entry_check.h"
#include "materials/formulas.h"
#include "materials/text_lines.h"
#include "math/input_error.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace sahl {
namespace {

constexpr double um_to_metres = 1e-6;
constexpr double least_transmittance = 1e-6; // what a printed 0 is taken as

/// What the lines of one glass have said so far.
struct Draft {
    GlassEntry entry;
    int formula = 0;
    TextLine name_line{};
    struct Transmittance {
        double um, share, mm;
    };
    std::vector<Transmittance> internal;
};

/// NM name formula MIL n_d V_d …
Draft begin(std::vector<std::string_view> const& words, TextLine const& line, std::string const& place,
            std::string const& maker) {
    auto const formula = words.size() > 2 ? number_of(words[2]) : std::nullopt;
    if (!formula || agf_formula_name(static_cast<int>(std::clamp(*formula, 0.0, 99.0))).empty() ||
        *formula != std::floor(*formula))
        throw InputError(place,
                         "this glass has formula \"" + std::string(words.size() > 2 ? words[2] : "") + "\"",
                         "write NM, its name, and a formula from 1 (Schott) to 13 (Extended 3)");
    Draft draft;
    draft.name_line = line;
    draft.formula = static_cast<int>(*formula);
    draft.entry.maker = maker;
    draft.entry.name = std::string(words[1]);
    draft.entry.medium.name = draft.entry.name;
    draft.entry.formula =
        "AGF formula " + std::to_string(draft.formula) + ", " + std::string(agf_formula_name(draft.formula));
    if (words.size() > 5) {
        draft.entry.nd = number_of(words[4]).value_or(0.0);
        draft.entry.vd = number_of(words[5]).value_or(0.0);
    }
    return draft;
}

/// IT wavelength in µm, transmittance of the inside, thickness in mm
void take_transmittance(Draft& draft, std::vector<double> const& numbers, std::string const& place) {
    if (numbers.size() < 3)
        return; // some catalogues leave lines without figures
    if (!(numbers[0] > 0.0 && numbers[1] >= 0.0 && numbers[1] <= 1.0 && numbers[2] > 0.0))
        throw InputError(
            place, "this transmittance cannot be",
            "write IT, a wavelength in µm above 0, a share from 0 to 1, a thickness in mm above 0");
    draft.internal.push_back({numbers[0], numbers[1], numbers[2]});
}

/// α = −ln(T)/thickness. Of two figures at one wavelength the thicker piece's counts, unless it lets nothing
/// through.
std::vector<std::pair<double, double>> absorption_of(std::vector<Draft::Transmittance> internal) {
    std::sort(internal.begin(), internal.end(), [](auto const& a, auto const& b) {
        return std::tuple(a.um, a.share == 0.0, -a.mm) < std::tuple(b.um, b.share == 0.0, -b.mm);
    });
    std::vector<std::pair<double, double>> table;
    for (auto const& [um, share, mm] : internal)
        if (table.empty() || table.back().first < um * um_to_metres)
            table.emplace_back(um * um_to_metres,
                               std::abs(std::log(std::max(share, least_transmittance))) / (mm * 1e-3));
    return table;
}

constexpr double d_line = 587.5618e-9; // m, helium; n_d is the index there

/// Of Sellmeier 2 there are two readings (see formulas.h): the one that gives the file's own n_d, to what
/// rounding of figures leaves, is meant.
Dispersion meant_by_index(Dispersion index, GlassEntry const& entry) {
    Dispersion const other = agf_sellmeier_2_with_squares(entry.coefficients);
    auto const off = [&](Dispersion const& reading) {
        double const n = refractive_index(reading, d_line);
        return std::isfinite(n) ? std::abs(n - entry.nd) : INFINITY;
    };
    return entry.nd > 1.0 && off(other) < 1e-4 && off(index) > 1e-3 ? other : index;
}

GlassEntry finish(Draft draft, std::string const& file) {
    std::string const place = place_of(file, draft.name_line);
    if (draft.entry.coefficients.empty())
        throw InputError(place, "\"" + draft.entry.name + "\" has no coefficients",
                         "give them in a line that begins with CD");
    if (draft.entry.medium.range.second == 0.0)
        throw InputError(place, "\"" + draft.entry.name + "\" has no range of wavelengths",
                         "give its two ends in µm in a line that begins with LD");
    auto const index = agf_formula(draft.formula, draft.entry.coefficients);
    if (!index)
        throw InputError(place, "\"" + draft.entry.name + "\" has more than ten coefficients", "leave ten");
    draft.entry.medium.index = draft.formula == 4 ? meant_by_index(*index, draft.entry) : *index;
    draft.entry.medium.absorption = absorption_of(std::move(draft.internal));
    check_entry(draft.entry, place);
    return std::move(draft.entry);
}

void take_line(Draft& draft, std::vector<std::string_view> const& words, std::string const& place) {
    std::string_view const kind = words.front();
    if (kind != "CD" && kind != "LD" && kind != "IT")
        return; // comments, densities, prices, resistance to acids …
    auto const numbers = numbers_of({words.begin() + 1, words.end()}, place);
    if (kind == "CD")
        draft.entry.coefficients = numbers;
    else if (kind == "IT")
        take_transmittance(draft, numbers, place);
    else if (numbers.size() >= 2)
        draft.entry.medium.range = {numbers[0] * um_to_metres, numbers[1] * um_to_metres};
}

} // namespace

std::vector<GlassEntry> read_agf(std::string_view bytes, std::string const& file, std::string const& maker) {
    std::string const text = without_byte_order(bytes);
    std::vector<GlassEntry> glasses;
    std::optional<Draft> draft;
    for (TextLine const& line : lines_of(text)) {
        auto const words = words_of(line.text);
        if (words.empty())
            continue;
        std::string const place = place_of(file, line);
        if (words.front() == "NM") {
            if (draft)
                glasses.push_back(finish(std::move(*draft), file));
            draft = begin(words, line, place, maker);
        } else if (draft)
            take_line(*draft, words, place);
    }
    if (!draft)
        throw InputError(file, "there is no glass in this file",
                         "an AGF file has a line that begins with NM for each glass");
    glasses.push_back(finish(std::move(*draft), file));
    return glasses;
}

} // namespace sahl

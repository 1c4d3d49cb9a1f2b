// In: a report of the catalogue. Out: the same for a person.
#include "run/glass_report.h"

#include "run/check_words.h"

#include <algorithm>
#include <cmath>

namespace sahl {
namespace {

std::string text_at(Value const& table, char const* key) {
    return std::get<std::string>(table.find(key)->data);
}

/// Nothing where the report has null.
std::optional<double> number_at(Value const& table, char const* key) {
    auto const* const number = std::get_if<double>(&table.find(key)->data);
    return number ? std::optional(*number) : std::nullopt;
}

Array const& list_at(Value const& table, char const* key) {
    return std::get<Array>(table.find(key)->data);
}

std::string figure(char const* format, std::optional<double> number, char const* otherwise = "-") {
    std::string buffer(64, '\0');
    if (!number)
        return otherwise;
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    buffer.resize(static_cast<std::size_t>(std::snprintf(buffer.data(), buffer.size(), format, *number)));
#pragma GCC diagnostic pop
    return buffer;
}

/// "312 – 2325 nm"
std::string range_text(Value const& entry, char const* key) {
    auto const* const range = std::get_if<Array>(&entry.find(key)->data);
    if (!range)
        return "not stated";
    return words("%.6g – %.6g nm", std::get<double>((*range)[0].data), std::get<double>((*range)[1].data));
}

bool in_range(Value const& entry) {
    return std::get<bool>(entry.find("in_range")->data);
}

/// The equation behind "formula 2": what the catalogue's numbers mean.
std::string equation(std::string const& formula) {
    constexpr std::pair<std::string_view, char const*> equations[] = {
        {"formula 1", "n² − 1 = c1 + c2 λ²/(λ² − c3²) + …"},
        {"formula 2", "n² − 1 = c1 + c2 λ²/(λ² − c3) + …"},
        {"formula 3", "n² = c1 + c2 λ^c3 + c4 λ^c5 + …"},
        {"formula 4", "n² = c1 + c2 λ^c3/(λ² − c4^c5) + …"},
        {"formula 5", "n = c1 + c2 λ^c3 + c4 λ^c5 + …"},
        {"formula 6", "n − 1 = c1 + c2/(c3 − λ⁻²) + …"},
        {"formula 7", "Herzberger"},
        {"formula 8", "(n² − 1)/(n² + 2) = c1 + c2 λ²/(λ² − c3) + c4 λ²"},
        {"formula 9", "n² = c1 + c2/(λ² − c3) + c4 (λ − c5)/((λ − c5)² + c6)"}};
    for (auto const& [name, text] : equations)
        if (name == formula)
            return formula + ": " + text + ", λ in µm";
    return formula;
}

std::string coefficients_text(Value const& glass) {
    std::string text;
    for (Value const& c : list_at(glass, "coefficients"))
        text += (text.empty() ? "" : "  ") + words("%.10g", std::get<double>(c.data));
    return text;
}

/// "1.51680 (printed by the maker: 1.5168)"
std::string with_printed(char const* format, Value const& glass, char const* key, char const* printed) {
    std::string const maker = figure("%.10g", number_at(glass, printed), "");
    return figure(format, number_at(glass, key)) +
           (maker.empty() ? "" : "   (printed by the maker: " + maker + ")");
}

std::string card(Value const& report, Value const& glass) {
    double const at = *number_at(report, "at_nm"), thickness = *number_at(report, "thickness_mm");
    std::string text = text_at(glass, "full_name") + "\n";
    auto const line = [&](std::string const& what, std::string const& value) {
        text += "  " + what + std::string(what.size() < 26 ? 26 - what.size() : 1, ' ') + value + "\n";
    };
    line(words("n at %.7g nm", at),
         figure("%.7f", number_at(glass, "n"), "none: the formula has no real value") +
             (in_range(glass) ? "" : "   (outside the formula's range)"));
    line("n_d", with_printed("%.6f", glass, "nd", "printed_nd"));
    line("V_d", with_printed("%.3f", glass, "vd", "printed_vd"));
    line("formula", equation(text_at(glass, "formula")));
    if (!list_at(glass, "coefficients").empty())
        line("coefficients", coefficients_text(glass));
    line("holds over", range_text(glass, "range_nm"));
    auto const internal = number_at(glass, "internal_transmittance");
    if (!internal) {
        line("absorption", "not in the catalogue: none is traced");
        return text;
    }
    line("absorption", words("%.4g /mm", *number_at(glass, "absorption_per_mm")));
    line("  known over", range_text(glass, "absorption_range_nm"));
    line(words("%.6g mm let through", thickness),
         words("%.5f of the light inside; ", *internal) +
             figure("%.5f", number_at(glass, "plate_transmittance")) + " with both faces in air");
    return text;
}

std::string metal_card(Value const& report, Value const& metal) {
    return words(
        "%s at %.7g nm%s\n  n + ik        %.5f + %.5f i\n  reflectance   %.5f at normal incidence from air\n"
        "  table         %s\n",
        text_at(metal, "name").c_str(), *number_at(report, "at_nm"),
        in_range(metal) ? "" : " (outside the table: its end is taken)", *number_at(metal, "n"),
        *number_at(metal, "k"), *number_at(metal, "reflectance"), range_text(metal, "range_nm").c_str());
}

std::string table(Value const& report) {
    std::string text = words(
        "%-26s %9s %9s %8s  %-19s  %s\n", "glass", words("n(%.6g)", *number_at(report, "at_nm")).c_str(),
        "n_d", "V_d", "range of n", words("inside, %.6g mm", *number_at(report, "thickness_mm")).c_str());
    for (Value const& glass : list_at(report, "glasses"))
        text += words("%-26s %9s %9s %8s  ", text_at(glass, "full_name").c_str(),
                      figure(in_range(glass) ? "%.6f" : "(%.5f)", number_at(glass, "n")).c_str(),
                      figure("%.6f", number_at(glass, "nd")).c_str(),
                      figure("%.3f", number_at(glass, "vd")).c_str()) +
                words("%-21s  ", range_text(glass, "range_nm").c_str()) + // an en dash has three bytes
                figure("%.5f", number_at(glass, "internal_transmittance")) + "\n";
    for (Value const& metal : list_at(report, "metals"))
        text += metal_card(report, metal);
    return text;
}

/// Names in lines of up to 110 columns, with the maker before them.
std::string names_by_maker(Value const& report) {
    std::vector<std::pair<std::string, std::vector<std::string>>> makers;
    auto const add = [&](std::string const& maker, std::string const& name) {
        auto found =
            std::find_if(makers.begin(), makers.end(), [&](auto const& m) { return m.first == maker; });
        if (found == makers.end())
            found = makers.insert(makers.end(), {maker, {}});
        found->second.push_back(name);
    };
    for (Value const& glass : list_at(report, "glasses"))
        add(text_at(glass, "maker"), text_at(glass, "name"));
    for (Value const& metal : list_at(report, "metals"))
        add("metals", text_at(metal, "name"));
    std::string text;
    for (auto& [maker, names] : makers) {
        std::sort(names.begin(), names.end());
        text += (maker.empty() ? "pages" : maker) + words(" (%zu)", names.size());
        std::size_t column = 200;
        for (std::string const& name : names) {
            if (column + name.size() > 110) {
                text += "\n ";
                column = 1;
            }
            text += " " + name;
            column += 1 + name.size();
        }
        text += "\n\n";
    }
    return text + "sahl glass NAME prints one, sahl glass 'N-SF*' a table, sahl glass --nd 1.52 --vd 64 the "
                  "nearest.\n";
}

} // namespace

std::string glass_text(Value const& report) {
    if (std::get<bool>(report.find("everything")->data))
        return names_by_maker(report);
    Array const &glasses = list_at(report, "glasses"), &metals = list_at(report, "metals");
    if (glasses.size() == 1 && metals.empty())
        return card(report, glasses.front());
    if (glasses.empty() && metals.size() == 1)
        return metal_card(report, metals.front());
    return table(report);
}

} // namespace sahl

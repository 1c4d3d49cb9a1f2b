#include "report/sweep.h"

#include "report/chart.h"
#include "report/detectors.h"
#include "report/html.h"
#include "report/ledger.h"

#include <algorithm>
#include <array>

namespace sahl::report {

namespace {

constexpr std::size_t most_wavelengths = 8; // columns of a table

std::vector<std::string> detector_names(std::vector<SweepRow> const& sweep) {
    std::vector<std::string> names;
    for (SweepRow const& row : sweep)
        for (auto const& [name, unused] : entries_at(row.summary, "detectors"))
            if (std::find(names.begin(), names.end(), name) == names.end())
                names.push_back(name);
    return names;
}

Value const* detector_called(Value const& summary, std::string const& name) {
    for (auto const& [called, detector] : entries_at(summary, "detectors"))
        if (called == name)
            return detector;
    return nullptr;
}

/// The key's value in a row, as a link to the page of that run where the summary names its folder.
std::string value_html(PageInput const& input, std::size_t row) {
    std::string const value = figure(input.sweep[row].value);
    Value const* const runs = at(input.summary, {"sweep", "runs"});
    auto const* list = runs ? std::get_if<Array>(&runs->data) : nullptr;
    auto const folder = list && row < list->size() ? text_at((*list)[row], {"folder"}) : std::nullopt;
    return folder ? "<a href=\"" + relative_url(*folder) + "/report.html\">" + value + "</a>" : value;
}

std::string detector_html(PageInput const& input, std::string const& name, std::string const& axis) {
    std::vector<ChartPoint> points;
    HtmlTable table{{escaped(axis), "power (W)", "centroid (mm)", "mean direction"}, {}};
    for (std::size_t i = 0; i < input.sweep.size(); ++i) {
        SweepRow const& row = input.sweep[i];
        Value const* const found = detector_called(row.summary, name);
        Value const detector = found ? *found : Value();
        points.push_back({row.value, number_at(detector, {"power_W"})});
        table.rows.push_back({value_html(input, i), shown(at(detector, {"power_W"})),
                              shown(at(detector, {"centroid_mm"})), shown(at(detector, {"mean_direction"}))});
    }
    auto const picture = picture_of(name, input.pictures);
    return "<article><h3>" + escaped(name) + "</h3>\n" + line_chart_svg(points, axis, "power (W)") +
           (picture ? "<details><summary>Picture of the first run</summary>" + picture_html(name, *picture) +
                          "</details>"
                    : "") +
           "<details><summary>Values</summary>" + html_of(table) + "</details></article>\n";
}

/// The mean direction of the light that left the scene, run by run, a column for each wavelength.
std::string escaped_html(PageInput const& input, std::string const& axis) {
    std::vector<std::string> wavelengths;
    for (auto const& [wavelength, unused] : entries_at(input.sweep.front().summary, "escaped_direction"))
        if (wavelengths.size() < most_wavelengths)
            wavelengths.push_back(wavelength);
    if (wavelengths.empty())
        return {};
    HtmlTable table{{escaped(axis)}, {}};
    for (std::string const& wavelength : wavelengths)
        table.headings.push_back(escaped(wavelength) + " nm");
    for (SweepRow const& row : input.sweep) {
        table.rows.push_back({figure(row.value)});
        for (std::string const& wavelength : wavelengths)
            table.rows.back().push_back(shown(at(row.summary, {"escaped_direction", wavelength})));
    }
    return "<details><summary>Mean direction of the light that escaped</summary>" + html_of(table) +
           "</details>\n";
}

std::string verdict(PageInput const& input) {
    std::string open;
    std::size_t stated = 0;
    for (SweepRow const& row : input.sweep) {
        auto const closes = ledger_closes(row.summary);
        stated += closes ? 1 : 0;
        if (closes && !*closes)
            open += (open.empty() ? "" : ", ") + figure(row.value);
    }
    if (stated == 0)
        return {};
    return open.empty() ? "<p class=\"good\">✓ The ledger closes in all " + count(stated) + " runs.</p>\n"
                        : "<p class=\"bad\">⚑ The ledger does not close at " + open + ".</p>\n";
}

} // namespace

std::string unit_of_key(std::string_view key) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 11> units{{{"_per_mm2", "1/mm²"},
                                                                                   {"_per_mm", "1/mm"},
                                                                                   {"_um2", "µm²"},
                                                                                   {"_um4", "µm⁴"},
                                                                                   {"_deg", "°"},
                                                                                   {"_rad", "rad"},
                                                                                   {"_mm", "mm"},
                                                                                   {"_nm", "nm"},
                                                                                   {"_m", "m"},
                                                                                   {"_W", "W"},
                                                                                   {"_s", "s"}}};
    key = key.substr(0, key.find('[', key.find_last_of('.') == key.npos ? 0 : key.find_last_of('.')));
    for (auto const& [suffix, unit] : units)
        if (key.ends_with(suffix))
            return std::string(unit);
    return {};
}

std::string sweep_html(PageInput const& input) {
    if (input.sweep.empty())
        return {};
    std::string const unit = unit_of_key(input.sweep_key);
    std::string const axis = input.sweep_key + (unit.empty() ? "" : " (" + unit + ")");
    std::string out = verdict(input) + "<div class=\"views\">\n";
    for (std::string const& name : detector_names(input.sweep))
        out += detector_html(input, name, axis);
    return out + "</div>\n" + escaped_html(input, axis);
}

} // namespace sahl::report

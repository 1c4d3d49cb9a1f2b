#include "report/sweep.h"

#include "report/chart.h"
#include "report/detectors.h"
#include "report/heat_map.h"
#include "report/html.h"
#include "report/ledger.h"

#include <algorithm>
#include <array>
#include <cmath>

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

std::string shown_value(Value const& value) {
    return value.is_number() ? figure(number_at(value, {}).value_or(NAN)) : shown(&value);
}

/// The keys' values in a row, one cell each, the first a link to the page of that run where the summary names
/// its folder.
std::vector<std::string> value_cells(PageInput const& input, std::size_t row) {
    std::vector<std::string> cells;
    for (Value const& value : input.sweep[row].values)
        cells.push_back(shown_value(value));
    Value const* const runs = at(input.summary, {"sweep", "runs"});
    auto const* list = runs ? std::get_if<Array>(&runs->data) : nullptr;
    auto const folder = list && row < list->size() ? text_at((*list)[row], {"folder"}) : std::nullopt;
    if (folder)
        cells.front() = "<a href=\"" + relative_url(*folder) + "/report.html\">" + cells.front() + "</a>";
    return cells;
}

std::string axis_name(std::string const& key) {
    std::string const unit = unit_of_key(key);
    return key + (unit.empty() ? "" : " (" + unit + ")");
}

std::vector<std::string> axis_headings(PageInput const& input) {
    std::vector<std::string> headings;
    for (std::string const& key : input.sweep_keys)
        headings.push_back(escaped(axis_name(key)));
    return headings;
}

/// A curve over one key, a map over the grid of two; of more there is the table.
std::string drawing_of(PageInput const& input, std::vector<std::optional<double>> const& powers) {
    std::vector<double> xs, ys;
    for (std::size_t i = 0; i < input.sweep.size();
         ++i) { // what is no number stands at its place in the list
        auto const& values = input.sweep[i].values;
        xs.push_back(number_at(values.back(), {}).value_or(static_cast<double>(i)));
        ys.push_back(number_at(values.front(), {}).value_or(static_cast<double>(i)));
    }
    if (input.sweep_keys.size() == 1) {
        std::vector<ChartPoint> points;
        for (std::size_t i = 0; i < xs.size(); ++i)
            points.push_back({xs[i], powers[i]});
        return line_chart_svg(points, axis_name(input.sweep_keys.front()), "power (W)");
    }
    return input.sweep_keys.size() == 2
               ? heat_map_svg(xs, ys, powers, axis_name(input.sweep_keys[1]), axis_name(input.sweep_keys[0]))
               : std::string();
}

std::string detector_html(PageInput const& input, std::string const& name) {
    std::vector<std::optional<double>> powers;
    HtmlTable table{axis_headings(input), {}};
    for (char const* heading : {"power (W)", "centroid (mm)", "mean direction"})
        table.headings.emplace_back(heading);
    for (std::size_t i = 0; i < input.sweep.size(); ++i) {
        Value const* const found = detector_called(input.sweep[i].summary, name);
        Value const detector = found ? *found : Value();
        powers.push_back(number_at(detector, {"power_W"}));
        table.rows.push_back(value_cells(input, i));
        for (char const* figure_name : {"power_W", "centroid_mm", "mean_direction"})
            table.rows.back().push_back(shown(at(detector, {figure_name})));
    }
    auto const picture = picture_of(name, input.pictures);
    return "<article><h3>" + escaped(name) + "</h3>\n" + drawing_of(input, powers) +
           (picture ? "<details><summary>Picture of the first run</summary>" + picture_html(name, *picture) +
                          "</details>"
                    : "") +
           "<details><summary>Values</summary>" + html_of(table) + "</details></article>\n";
}

/// The mean direction of the light that left the scene, run by run, a column for each wavelength.
std::string escaped_html(PageInput const& input) {
    std::vector<std::string> wavelengths;
    for (auto const& [wavelength, unused] : entries_at(input.sweep.front().summary, "escaped_direction"))
        if (wavelengths.size() < most_wavelengths)
            wavelengths.push_back(wavelength);
    if (wavelengths.empty())
        return {};
    HtmlTable table{axis_headings(input), {}};
    for (std::string const& wavelength : wavelengths)
        table.headings.push_back(escaped(wavelength) + " nm");
    for (SweepRow const& row : input.sweep) {
        table.rows.emplace_back();
        for (Value const& value : row.values)
            table.rows.back().push_back(shown_value(value));
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
        if (!closes || *closes)
            continue;
        open += open.empty() ? "" : "; ";
        for (std::size_t i = 0; i < row.values.size(); ++i)
            open += (i == 0 ? "" : ", ") + shown_value(row.values[i]);
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
    std::string out = verdict(input) + "<div class=\"views\">\n";
    for (std::string const& name : detector_names(input.sweep))
        out += detector_html(input, name);
    return out + "</div>\n" + escaped_html(input);
}

} // namespace sahl::report

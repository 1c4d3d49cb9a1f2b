#include "report/heat_map.h"

#include "image/ticks.h"
#include "report/html.h"

#include <algorithm>
#include <cmath>

namespace sahl::report {

namespace {

constexpr double width = 550, height = 300, left = 74, right = 14, top = 12, bottom = 46; // pixels
constexpr std::size_t most_name = 60;                                                     // characters
constexpr std::size_t most_labels = 8;                                                    // along an axis
constexpr double lightest = 0.06; // share of the colour at the least value, so that a square is seen

std::vector<double> distinct(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

double place_of(double value, std::vector<double> const& all) {
    return static_cast<double>(std::lower_bound(all.begin(), all.end(), value) - all.begin());
}

std::string label(double x, double y, char const* anchor, double value) {
    return std::string("<text class=\"") + anchor + "\" x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) +
           "\">" + tick_label(value) + "</text>\n";
}

} // namespace

std::string heat_map_svg(std::vector<double> const& xs, std::vector<double> const& ys,
                         std::vector<std::optional<double>> const& values, std::string const& x_name,
                         std::string const& y_name) {
    auto const columns = distinct(xs), rows = distinct(ys);
    double low = INFINITY, high = -INFINITY;
    for (auto const& value : values)
        if (value && std::isfinite(*value)) {
            low = std::min(low, *value);
            high = std::max(high, *value);
        }
    if (!(low <= high))
        return "<p class=\"note\">No values to draw.</p>\n";
    double const foot = height - bottom;
    double const dx = (width - left - right) / static_cast<double>(columns.size());
    double const dy = (foot - top) / static_cast<double>(rows.size());
    std::string out = "<svg class=\"chart\" viewBox=\"0 0 " + coordinate(width) + " " + coordinate(height) +
                      "\" role=\"img\" aria-label=\"power against " + escaped(x_name) + " and " +
                      escaped(y_name) + "\">\n";
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!values[i] || !std::isfinite(*values[i]))
            continue;
        double const share = high > low ? (*values[i] - low) / (high - low) : 1.0;
        out += "<rect class=\"cell\" fill=\"#1b5e9e\" fill-opacity=\"" +
               coordinate(lightest + (1.0 - lightest) * share) + "\" x=\"" +
               coordinate(left + dx * place_of(xs[i], columns)) + "\" y=\"" +
               coordinate(foot - dy * (place_of(ys[i], rows) + 1.0)) + "\" width=\"" + coordinate(dx) +
               "\" height=\"" + coordinate(dy) + "\"><title>" + tick_label(xs[i]) + ", " + tick_label(ys[i]) +
               ": " + figure(*values[i]) + " W</title></rect>\n";
    }
    for (std::size_t i = 0; i < columns.size(); i += (columns.size() + most_labels - 1) / most_labels)
        out += label(left + dx * (static_cast<double>(i) + 0.5), foot + 18.0, "middle", columns[i]);
    for (std::size_t i = 0; i < rows.size(); i += (rows.size() + most_labels - 1) / most_labels)
        out += label(left - 8.0, foot - dy * (static_cast<double>(i) + 0.5) + 4.0, "end", rows[i]);
    out += "<rect class=\"axis\" x=\"" + coordinate(left) + "\" y=\"" + coordinate(top) + "\" width=\"" +
           coordinate(width - left - right) + "\" height=\"" + coordinate(foot - top) + "\"/>\n";
    out += "<text class=\"middle name\" x=\"" + coordinate(left + 0.5 * (width - left - right)) + "\" y=\"" +
           coordinate(height - 8.0) + "\">" + escaped(shortened(x_name, most_name)) + "</text>\n";
    return out + "<text class=\"middle name\" transform=\"translate(14 " + coordinate(0.5 * (foot + top)) +
           ") rotate(-90)\">" + escaped(shortened(y_name, most_name)) +
           "</text>\n</svg>\n<p class=\"note\">" + "Power from " + figure(low) + " W (light) to " +
           figure(high) + " W (dark).</p>\n";
}

} // namespace sahl::report

#include "report/chart.h"

#include "image/ticks.h"
#include "report/html.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sahl::report {

namespace {

constexpr double width = 550, height = 300, left = 74, right = 14, top = 12, bottom = 46; // pixels
constexpr std::size_t most_dots = 120;
constexpr std::size_t most_name = 60; // characters

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void add(double value) {
        if (std::isfinite(value)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    /// A single value gets some room about it.
    void widen() {
        double const room = 0.05 * std::max(std::abs(low), std::abs(high));
        if (!(high - low > 1e-9 * room)) {
            low -= room > 0.0 ? room : 1.0;
            high += room > 0.0 ? room : 1.0;
        }
    }
};

std::string tick(double x, double y, bool below, double value) {
    std::string const at = " x1=\"" + coordinate(x) + "\" y1=\"" + coordinate(y) + "\" x2=\"";
    return below ? "<line class=\"grid\"" + at + coordinate(x) + "\" y2=\"" + coordinate(top) +
                       "\"/><text class=\"middle\" x=\"" + coordinate(x) + "\" y=\"" + coordinate(y + 18.0) +
                       "\">" + tick_label(value) + "</text>\n"
                 : "<line class=\"grid\"" + at + coordinate(width - right) + "\" y2=\"" + coordinate(y) +
                       "\"/><text class=\"end\" x=\"" + coordinate(x - 8.0) + "\" y=\"" +
                       coordinate(y + 4.0) + "\">" + tick_label(value) + "</text>\n";
}

} // namespace

std::string line_chart_svg(std::vector<ChartPoint> const& points, std::string const& x_name,
                           std::string const& y_name) {
    Range xs, ys;
    for (ChartPoint const& p : points)
        if (p.y) {
            xs.add(p.x);
            ys.add(*p.y);
        }
    if (!(xs.low <= xs.high) || !(ys.low <= ys.high))
        return "<p class=\"note\">No values to draw.</p>\n";
    if (ys.low >= 0.0 && ys.low < 0.5 * ys.high)
        ys.low = 0.0;
    if (ys.low == 0.0 && ys.high == 0.0)
        ys.high = 1.0;
    xs.widen();
    ys.widen();
    if (ys.low != 0.0) {
        double const room = 0.06 * (ys.high - ys.low);
        ys = {ys.low - room, ys.high + room};
    } else
        ys.high *= 1.06;

    double const foot = height - bottom;
    auto const px = [&](double x) {
        return left + (x - xs.low) / (xs.high - xs.low) * (width - left - right);
    };
    auto const py = [&](double y) { return foot - (y - ys.low) / (ys.high - ys.low) * (foot - top); };
    std::string out = "<svg class=\"chart\" viewBox=\"0 0 " + coordinate(width) + " " + coordinate(height) +
                      "\" role=\"img\" aria-label=\"" + escaped(y_name) + " against " + escaped(x_name) +
                      "\">\n";
    for (double const x : round_ticks(xs.low, xs.high, 7))
        out += tick(px(x), foot, true, x);
    for (double const y : round_ticks(ys.low, ys.high, 5))
        out += tick(left, py(y), false, y);
    out += "<rect class=\"axis\" x=\"" + coordinate(left) + "\" y=\"" + coordinate(top) + "\" width=\"" +
           coordinate(width - left - right) + "\" height=\"" + coordinate(foot - top) + "\"/>\n";
    std::string path, dots;
    bool joined = false;
    for (ChartPoint const& p : points) {
        bool const here = p.y && std::isfinite(p.x) && std::isfinite(*p.y);
        if (here) {
            path += (joined ? "L" : "M") + coordinate(px(p.x)) + " " + coordinate(py(*p.y));
            dots += "<circle class=\"dot\" cx=\"" + coordinate(px(p.x)) + "\" cy=\"" + coordinate(py(*p.y)) +
                    "\" r=\"3\"><title>" + tick_label(p.x) + ": " + tick_label(*p.y) + "</title></circle>\n";
        }
        joined = here;
    }
    out += "<path class=\"curve\" d=\"" + path + "\"/>\n" + (points.size() <= most_dots ? dots : "");
    out += "<text class=\"middle name\" x=\"" + coordinate(left + 0.5 * (width - left - right)) + "\" y=\"" +
           coordinate(height - 8.0) + "\">" + escaped(shortened(x_name, most_name)) + "</text>\n";
    return out + "<text class=\"middle name\" transform=\"translate(14 " + coordinate(0.5 * (foot + top)) +
           ") rotate(-90)\">" + escaped(shortened(y_name, most_name)) + "</text>\n</svg>\n";
}

} // namespace sahl::report

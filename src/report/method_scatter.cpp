#include "report/method_scatter.h"

#include "report/html.h"

#include <algorithm>
#include <cmath>

namespace sahl::report {

namespace {

constexpr double width = 640.0, height = 420.0, left = 80.0, right = 30.0, top = 40.0, bottom = 60.0;

/// Whole powers of ten about some values.
struct Decades {
    double low = 0.0, high = 1.0;

    explicit Decades(std::vector<double> const& values) {
        double least = INFINITY, most = 0.0;
        for (double const v : values)
            if (v > 0.0 && std::isfinite(v)) {
                least = std::min(least, v);
                most = std::max(most, v);
            }
        if (most > 0.0) {
            low = std::floor(std::log10(least));
            high = std::max(std::ceil(std::log10(most)), low + 1.0);
        }
    }
    double share(double v) const { return v > 0.0 ? (std::log10(v) - low) / (high - low) : 0.0; }
};

std::string line(double x1, double y1, double x2, double y2, char const* style) {
    return "<line x1=\"" + coordinate(x1) + "\" y1=\"" + coordinate(y1) + "\" x2=\"" + coordinate(x2) +
           "\" y2=\"" + coordinate(y2) + "\" " + style + "/>\n";
}

std::string words(double x, double y, std::string const& text, char const* style) {
    return "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" " + style + ">" + escaped(text) +
           "</text>\n";
}

std::string power_of_ten(double exponent) {
    return "1e" + std::to_string(static_cast<int>(exponent));
}

} // namespace

std::string method_scatter_svg(std::vector<ScatterPoint> const& points, std::string const& title,
                               std::string const& note) {
    std::vector<double> costs, errors;
    for (ScatterPoint const& p : points) {
        costs.push_back(p.nanoseconds);
        errors.insert(errors.end(), {p.rms, p.greatest});
    }
    Decades const x_axis(costs), y_axis(errors);
    auto const x_of = [&](double ns) { return left + x_axis.share(ns) * (width - left - right); };
    auto const y_of = [&](double rad) {
        return height - bottom - y_axis.share(rad) * (height - top - bottom);
    };
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 640 420\" font-family=\"sans-serif\" "
        "font-size=\"13\" role=\"img\">\n<rect width=\"640\" height=\"420\" fill=\"#fff\"/>\n";
    svg += words(left, 22.0, title, "font-weight=\"bold\" fill=\"#222\"");
    constexpr char const* grid = "stroke=\"#ddd\"";
    for (double e = x_axis.low; e <= x_axis.high; e += 1.0) {
        double const x = x_of(std::pow(10.0, e));
        svg += line(x, top, x, height - bottom, grid) +
               words(x, height - bottom + 18.0, power_of_ten(e), "text-anchor=\"middle\" fill=\"#555\"");
    }
    for (double e = y_axis.low; e <= y_axis.high; e += 1.0) {
        double const y = y_of(std::pow(10.0, e));
        svg += line(left, y, width - right, y, grid) +
               words(left - 8.0, y + 4.0, power_of_ten(e), "text-anchor=\"end\" fill=\"#555\"");
    }
    svg += words(0.5 * (left + width - right), height - bottom + 36.0, "CPU nanoseconds per segment",
                 "text-anchor=\"middle\" fill=\"#222\"");
    svg += words(left, height - 8.0,
                 "error of directions against " + note + ", rad: RMS, and the greatest above it",
                 "font-size=\"11\" fill=\"#555\"");
    std::vector<ScatterPoint> front;
    std::copy_if(points.begin(), points.end(), std::back_inserter(front),
                 [](auto const& p) { return p.front; });
    std::sort(front.begin(), front.end(),
              [](auto const& a, auto const& b) { return a.nanoseconds < b.nanoseconds; });
    for (std::size_t i = 1; i < front.size(); ++i)
        svg += line(x_of(front[i - 1].nanoseconds), y_of(front[i - 1].rms), x_of(front[i].nanoseconds),
                    y_of(front[i].rms), "stroke=\"#0f766e\" stroke-dasharray=\"4 3\"");
    for (ScatterPoint const& p : points) {
        double const x = x_of(p.nanoseconds), y = y_of(p.rms);
        svg += line(x, y, x, y_of(p.greatest), "stroke=\"#c2410c\"");
        svg += "<circle cx=\"" + coordinate(x) + "\" cy=\"" + coordinate(y) +
               "\" r=\"5\" stroke=\"#0f766e\" fill=\"" + (p.front ? "#0f766e" : "#fff") + "\"/>\n";
        bool const at_right = x > width - right - 110.0;
        svg += words(at_right ? x - 9.0 : x + 9.0, y - 7.0, p.name,
                     at_right ? "text-anchor=\"end\" fill=\"#222\"" : "fill=\"#222\"");
    }
    return svg + "</svg>\n";
}

} // namespace sahl::report

#include "report/method_page.h"

#include "report/html.h"

#include <cstdio>

namespace sahl::report {

namespace {

constexpr char const* head =
    "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<style>\n"
    "body { font: 15px/1.5 sans-serif; color: #222; background: #fff; max-width: 46rem; margin: 2rem auto; "
    "padding: 0 1rem }\n"
    "svg { width: 100%; height: auto }\n"
    "table { border-collapse: collapse; width: 100% }\n"
    "th, td { text-align: right; padding: .2rem .6rem; border-bottom: 1px solid #ddd }\n"
    "th:first-child, td:first-child { text-align: left }\n.front { font-weight: bold }\n</style>\n";

std::string cell(double value) {
    char text[64];
    std::snprintf(text, sizeof text, "<td>%.3g</td>", value);
    return text;
}

} // namespace

std::string method_page(std::vector<ScatterPoint> const& points, std::string const& title,
                        std::string const& note) {
    std::string page = head;
    page +=
        "<title>" + escaped(title) + "</title>\n</head>\n<body>\n<h1>" + escaped(title) +
        "</h1>\n<p>The same rays by every method: what a segment costs, and how far directions err against " +
        escaped(note) + ". Bold: no other method is both faster and nearer.</p>\n" +
        method_scatter_svg(points, title, note) +
        "<table>\n<tr><th>method</th><th>CPU ns per segment</th><th>RMS, rad</th><th>RMS on leaving, "
        "rad</th><th>greatest, rad</th><th>other events, %</th></tr>\n";
    for (ScatterPoint const& p : points)
        page += std::string("<tr") + (p.front ? " class=\"front\"" : "") + "><td>" + escaped(p.name) +
                "</td>" + cell(p.nanoseconds) + cell(p.rms) + cell(p.leaving) + cell(p.greatest) +
                cell(100.0 * p.changed) + "</tr>\n";
    return page + "</table>\n</body>\n</html>\n";
}

} // namespace sahl::report

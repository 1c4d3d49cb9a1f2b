// In: points, some without a value. Out: a small line chart as inline SVG.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sahl::report {

struct ChartPoint {
    double x;
    std::optional<double> y;
};

/// The points in their order, joined where neighbours both have a value. The y axis begins at 0 where that
/// leaves the curve at least half of the height. Names of axes are escaped here.
std::string line_chart_svg(std::vector<ChartPoint> const& points, std::string const& x_name,
                           std::string const& y_name);

} // namespace sahl::report

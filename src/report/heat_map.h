// In: values on a grid. Out: a field of squares, the darker the greater, as inline SVG.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sahl::report {

/// A square for each value, in equal steps over the distinct x and y in ascending order; y goes up. Where
/// there is no value the square is left out; of two at one place the last one shows. Names are escaped here.
std::string heat_map_svg(std::vector<double> const& xs, std::vector<double> const& ys,
                         std::vector<std::optional<double>> const& values, std::string const& x_name,
                         std::string const& y_name);

} // namespace sahl::report

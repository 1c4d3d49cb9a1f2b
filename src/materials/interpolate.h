// In: a table in ascending order and a place. Out: the value there: linear in between, constant beyond the
// ends.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace sahl {

/// abscissa(point), ordinate(point) are what they say. NaN for an empty table, and at a NaN.
template <class Point, class Abscissa, class Ordinate>
double interpolate(std::vector<Point> const& table, double x, Abscissa abscissa, Ordinate ordinate) {
    if (table.empty() || x != x)
        return std::numeric_limits<double>::quiet_NaN();
    auto const above = std::lower_bound(table.begin(), table.end(), x,
                                        [&](Point const& p, double value) { return abscissa(p) < value; });
    if (above == table.end())
        return ordinate(table.back());
    if (above == table.begin())
        return ordinate(table.front());
    auto const below = above - 1;
    double const share = (x - abscissa(*below)) / (abscissa(*above) - abscissa(*below));
    return ordinate(*below) + share * (ordinate(*above) - ordinate(*below));
}

} // namespace sahl

// In: nothing. Out: the part of a line that is asked about.
#pragma once

namespace sahl {

/// A line from `from` to `to`, t in units of the direction, which may have any length but zero.
struct Reach {
    double from = 0.0, to = 0.0;
};

} // namespace sahl

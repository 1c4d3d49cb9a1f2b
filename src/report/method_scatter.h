// In: what each method costs and how far it errs. Out: a chart of one against the other, both in powers of
// ten, as SVG.
#pragma once

#include <string>
#include <vector>

namespace sahl::report {

struct ScatterPoint {
    std::string name;
    double nanoseconds, rms, greatest; // per segment; rad
    bool front;
};

/// Points of no error stand at the foot. The front's are filled and joined; a bar leads up to the greatest
/// error. `note` says what the errors are held against.
std::string method_scatter_svg(std::vector<ScatterPoint> const& points, std::string const& title,
                               std::string const& note);

} // namespace sahl::report

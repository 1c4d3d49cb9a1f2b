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
    double leaving = 0.0; // rad, RMS of what leaves the scene alone; shown in tables
    double changed = 0.0; // share of rays that meet other events; the same
};

/// Points of no error stand at the foot. The front's are filled and joined; a bar leads up to the greatest
/// error. `note` says what the errors are held against.
std::string method_scatter_svg(std::vector<ScatterPoint> const& points, std::string const& title,
                               std::string const& note);

} // namespace sahl::report

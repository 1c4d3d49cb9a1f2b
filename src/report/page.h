// In: the summary of a run and some of its paths. Out: report.html, the page a person looks at.
#pragma once

#include "scene/scene.h"
#include "scene/value.h"
#include "trace/segment.h"

#include <string>
#include <vector>

namespace sahl {

/// One row of a sweep: the value of each of its keys, and the summary of its run.
struct SweepRow {
    std::vector<Value> values;
    Value summary;
};

struct PageInput {
    Value const& summary;              // summary.json as written
    Scene const& scene;                // of the run, or of the first run of a sweep
    std::vector<Segment> paths;        // of a sample of the rays, in the order of the log
    std::uint64_t rays_shown = 0;      // how many rays they belong to
    std::vector<std::string> pictures; // detector pictures, relative to the page, e.g. "detectors/screen.png"
    std::vector<std::string> sweep_keys; // none: no sweep
    std::vector<SweepRow> sweep;
};

/// The whole page as one HTML text: no script from elsewhere, no request beyond the pictures beside it. All
/// text that comes from files is escaped.
std::string report_page(PageInput const& input);

} // namespace sahl

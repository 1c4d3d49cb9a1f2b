// In: the summaries of a sweep's runs. Out: sweep.csv, and the summary of the whole.
#pragma once

#include "report/page.h"

#include <string>
#include <utility>
#include <vector>

namespace sahl {

/// The numbers of a summary under the path that leads to each: `detectors.screen.power_W`, `energy_W.cut`,
/// `…mean_direction[0]`. Times are left out; what is null is not there.
using Figures = std::vector<std::pair<std::string, double>>;
Figures figures_of(Value const& summary);

/// One row a run: the values of its keys, then its figures, one column each; empty where a run has none.
std::string sweep_csv(std::vector<std::string> const& keys, std::vector<SweepRow> const& rows);

/// How long the runs took that were made now, and which were kept from an earlier start.
struct SweepTime {
    double seconds = 0.0;
    std::vector<char> kept;
};

/// What all runs have in common, the sums of what adds up, and each run's values and folder.
Value sweep_summary(std::vector<std::string> const& keys, std::vector<SweepRow> const& rows,
                    std::vector<std::string> const& set, std::vector<std::string> const& failures,
                    SweepTime const& time);

/// "007": the folder of a run under runs/.
std::string run_name(std::size_t run);

} // namespace sahl

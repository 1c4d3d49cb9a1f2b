// In: the summaries of a sweep's runs. Out: sweep.csv, and the summary of the whole.
#pragma once

#include "report/page.h"

#include <string>
#include <vector>

namespace sahl {

/// One row a run, one column a figure that is a number: `detectors.screen.power_W`, `energy_W.cut`,
/// `…mean_direction[0]`. Times are left out.
std::string sweep_csv(std::string const& key, std::vector<SweepRow> const& rows);

/// What all runs have in common, the sums of what adds up, and each run's value and folder.
Value sweep_summary(std::string const& key, std::vector<SweepRow> const& rows,
                    std::vector<std::string> const& set, std::vector<std::string> const& failures);

} // namespace sahl

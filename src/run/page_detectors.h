// In: what detectors recorded, in memory or in the files of a run. Out: the same as a page shows it.
#pragma once

#include "record/detector.h"
#include "report/page.h"

#include <filesystem>
#include <vector>

namespace sahl {

/// Pictures with more pixels than a page shows are averaged over blocks of them.
std::vector<PageDetector> page_detectors(std::vector<DetectorRecord> const& records);

/// Of the .csv files in `folder`; what is not there, or is no table, is left out.
std::vector<PageDetector> page_detectors(std::vector<DetectorSpec> const& specs,
                                         std::filesystem::path const& folder);

} // namespace sahl

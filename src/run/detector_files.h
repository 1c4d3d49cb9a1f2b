// In: what a detector recorded. Out: its irradiance as EXR, CSV and a PNG that a person can look at.
#pragma once

#include "record/detector.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sahl {

/// Writes folder/NAME.exr, .csv, .png (W/mm², first row at the top). Returns the PNG's file name.
std::string write_detector_files(DetectorRecord const& record, std::filesystem::path const& folder,
                                 std::string const& title);

} // namespace sahl

// In: what a detector recorded. Out: its irradiance as EXR, CSV and a PNG that a person can look at, and
// tables of what else it was asked to record.
#pragma once

#include "record/detector.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sahl {

/// Writes folder/NAME.exr, .csv, .png of a rectangle (W/mm², first row at the top), and where asked for
/// NAME.spot.csv, NAME.far_field.csv and .exr, NAME.spectrum.csv, NAME.optical_path.csv. Returns the PNG's
/// file name, empty where there is none.
///   wavelengths   m, of record.by_wavelength()
std::string write_detector_files(DetectorRecord const& record, std::filesystem::path const& folder,
                                 std::string const& title, std::vector<double> const& wavelengths);

/// The name of a detector's files without their endings: its own, without what a file name must not hold.
std::string detector_file_name(std::string name);

} // namespace sahl

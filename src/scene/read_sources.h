// In: the tables [[source]] and [[detector]]. Out: where light comes from and where it is counted, in the
// world.
#pragma once

#include "scene/experiment.h"
#include "scene/read_transform.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace sahl {

/// folder   that of the experiment's file
/// Throws InputError. Names are not compared with one another here.
std::vector<SourceSpec> read_sources(Array const& tables, Groups const& groups,
                                     std::filesystem::path const& folder);

std::vector<DetectorSpec> read_detectors(Array const& tables, Groups const& groups);

/// The wavelengths (m) of a source with their weights, from wavelengths_nm or lines, weights and spectrum;
/// 587.5618 nm without.
std::vector<std::pair<double, double>> read_wavelengths(Fields const& source,
                                                        std::filesystem::path const& folder);

/// The same from the key `spectrum` alone: the middles of its bins, with the power in each; bins without
/// light are left out.
std::vector<std::pair<double, double>> binned_spectrum(Fields const& source,
                                                       std::filesystem::path const& folder);
/// Gives each wavelength the spectrum's value there as its weight. Throws where it has none.
void weigh_by_spectrum(Fields const& source, std::filesystem::path const& folder,
                       std::vector<std::pair<double, double>>& wavelengths);

/// Single rays under the key `rays` or `file`, in the world, and the sum of their powers where they have
/// some, else 0.
struct RayList {
    std::vector<RaySpec> rays;
    double power = 0.0;
    std::optional<double> wavelength{}; // m, where the file says which
    bool mixed = false;                 // its rays have wavelengths of their own, which are not read
};
RayList read_ray_list(Value const& list, Affine const& to_world);
/// A .csv, or by its name's end .tm25ray an IES TM-25.
RayList read_ray_file(std::filesystem::path const& path, Affine const& to_world);
RayList read_tm25(std::filesystem::path const& path, Affine const& to_world);

/// A CSV file's rows of numbers with the lines they stand on. A first line of names is passed over where
/// `is_header` says so (it is given the fields), and so are empty lines and those that begin with #. Throws
/// InputError, with `columns`, where something is no number.
struct CsvRow {
    std::vector<double> numbers;
    std::string place; // file:line
};
void read_csv(std::filesystem::path const& path, std::string const& columns,
              bool (*is_header)(std::vector<std::string_view> const&),
              std::function<void(CsvRow const&)> const& take);

} // namespace sahl

#include "run/page_detectors.h"

#include "run/detector_files.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <numbers>

namespace sahl {

namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t most_pixels = 1U << 18; // of all pictures of a page: 512 × 512, or more of fewer
constexpr double per_mm2 = 1e-6;                // of W/m²
constexpr double degrees = 180.0 / std::numbers::pi;

/// W/mm², averaged over blocks so that no more than `most` are left.
void take_picture(PageDetector& page, std::uint32_t columns, std::uint32_t rows,
                  std::vector<double> const& field, std::uint64_t most) {
    if (field.size() != std::size_t{columns} * rows || field.empty())
        return;
    std::uint32_t block = 1;
    while (std::uint64_t{(columns + block - 1) / block} * ((rows + block - 1) / block) > most)
        ++block;
    page.columns = (columns + block - 1) / block;
    page.rows = (rows + block - 1) / block;
    page.pixels_in_one = block;
    for (std::uint32_t y = 0; y < rows; y += block)
        for (std::uint32_t x = 0; x < columns; x += block) {
            double sum = 0.0;
            std::uint32_t pixels = 0;
            for (std::uint32_t v = y; v < std::min(rows, y + block); ++v)
                for (std::uint32_t u = x; u < std::min(columns, x + block); ++u, ++pixels)
                    sum += field[std::size_t{v} * columns + u];
            page.irradiance.push_back(static_cast<float>(sum / pixels));
        }
}

std::uint64_t room_for_each(std::size_t detectors) {
    return std::max<std::uint64_t>(32 * 32, most_pixels / std::max<std::size_t>(1, detectors));
}

/// The numbers of a table with a head, row by row; none where one of its cells is no number.
std::vector<std::vector<double>> table_of(fs::path const& file) {
    std::ifstream in(file, std::ios::binary);
    std::vector<std::vector<double>> rows;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        auto& row = rows.emplace_back();
        for (char const *at = line.data(), *end = at + line.size(); at < end; ++at) {
            double number = 0.0;
            auto const [next, fault] = std::from_chars(at, end, number);
            if (fault != std::errc() || (next < end && *next != ','))
                return {};
            row.push_back(number);
            at = next;
        }
        if (row.size() != rows.front().size())
            return {};
    }
    return rows;
}

std::vector<double> column(std::vector<std::vector<double>> const& table, std::size_t which) {
    std::vector<double> numbers;
    for (auto const& row : table)
        if (which < row.size())
            numbers.push_back(row[which]);
    return numbers;
}

} // namespace

std::vector<PageDetector> page_detectors(std::vector<DetectorRecord> const& records) {
    std::vector<PageDetector> pages;
    for (DetectorRecord const& record : records) {
        DetectorSpec const& spec = record.spec();
        PageDetector& page = pages.emplace_back();
        page.name = spec.name;
        std::vector<double> field = record.irradiance();
        for (double& x : field)
            x *= per_mm2;
        take_picture(page, spec.columns, spec.rows, field, room_for_each(records.size()));
        if (spec.spot)
            for (double const radius : record.encircled())
                page.encircled_mm.push_back(radius * 1e3);
        if (auto const& far = record.far_field())
            page.far_field = {far->far().rings, far->far().sectors, far->far().largest * degrees,
                              far->intensities()};
        if (spec.path_bins > 0) {
            Histogram const histogram = record.optical_paths();
            page.optical_path = {histogram.from * 1e3, histogram.to * 1e3, histogram.powers};
        }
    }
    return pages;
}

std::vector<PageDetector> page_detectors(std::vector<DetectorSpec> const& specs, fs::path const& folder) {
    std::vector<PageDetector> pages;
    for (DetectorSpec const& spec : specs) {
        PageDetector& page = pages.emplace_back();
        page.name = spec.name;
        std::string const stem = (folder / detector_file_name(spec.name)).string();
        if (spec.kind == DetectorKind::rectangle)
            take_picture(page, spec.columns, spec.rows, column(table_of(stem + ".csv"), 2),
                         room_for_each(specs.size()));
        if (spec.spot)
            page.encircled_mm = column(table_of(stem + ".spot.csv"), 1);
        if (spec.far_field)
            page.far_field = {spec.far_field->rings, spec.far_field->sectors,
                              spec.far_field->largest * degrees,
                              column(table_of(stem + ".far_field.csv"), 5)};
        if (spec.path_bins > 0)
            if (auto const bins = table_of(stem + ".optical_path.csv");
                !bins.empty() && bins.front().size() == 3)
                page.optical_path = {bins.front()[0], bins.back()[1], column(bins, 2)};
    }
    return pages;
}

} // namespace sahl

#include "run/detector_files.h"

#include "image/image.h"
#include "math/input_error.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <numeric>

namespace sahl {

namespace {

constexpr double per_mm2 = 1e-6; // of W/m²
constexpr double spot_to_mean =
    30.0; // peak over mean from which on a picture is drawn with a logarithmic scale

void write_csv(DetectorRecord const& record, std::vector<double> const& field,
               std::filesystem::path const& file) {
    std::ofstream out(file, std::ios::binary);
    auto const number = [](double x) {
        char text[40];
        auto const end = std::to_chars(text, text + sizeof text, x).ptr;
        return std::string(text, end);
    };
    DetectorSpec const& spec = record.spec();
    out << "x_mm,y_mm,irradiance_W_per_mm2\n";
    for (std::uint32_t row = 0; row < spec.rows; ++row)
        for (std::uint32_t column = 0; column < spec.columns; ++column) {
            double const x = ((column + 0.5) / spec.columns - 0.5) * spec.size.x;
            double const y = (0.5 - (row + 0.5) / spec.rows) * spec.size.y;
            out << number(x * 1e3) << ',' << number(y * 1e3) << ','
                << number(field[std::size_t{row} * spec.columns + column] * per_mm2) << '\n';
        }
    if (!out.flush())
        throw InputError(file.string(), "cannot be written", "see that there is room on the disk");
}

} // namespace

std::string write_detector_files(DetectorRecord const& record, std::filesystem::path const& folder,
                                 std::string const& title) {
    std::filesystem::create_directories(folder);
    DetectorSpec const& spec = record.spec();
    // a name may hold what a file name must not
    std::string name = spec.name;
    std::replace_if(
        name.begin(), name.end(),
        [](unsigned char c) {
            return c < 0x20 ||
                   std::string_view("/\\:*?\"<>|").find(static_cast<char>(c)) != std::string_view::npos;
        },
        '_');
    std::vector<double> const field = record.irradiance();
    Image image{spec.columns, spec.rows, 1, {}};
    for (double const irradiance : field)
        image.pixels.push_back(static_cast<float>(irradiance * per_mm2));
    write_image(folder / (name + ".exr"), image,
                {{"title", title}, {"unit", "W/mm2"}, {"detector", spec.name}});
    write_csv(record, field, folder / (name + ".csv"));
    double const peak = std::max(record.peak() * per_mm2, 1e-300);
    double const mean =
        std::accumulate(field.begin(), field.end(), 0.0) / static_cast<double>(field.size()) * per_mm2;
    double const decades = peak > spot_to_mean * mean ? 4.0 : 0.0;
    write_image(folder / (name + ".png"), false_colour(image, peak, decades, spec.name, "W/mm\xC2\xB2",
                                                       spec.size.x * 1e3, spec.size.y * 1e3));
    return name + ".png";
}

} // namespace sahl

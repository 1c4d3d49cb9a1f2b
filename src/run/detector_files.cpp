#include "run/detector_files.h"

#include "image/image.h"
#include "math/input_error.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <initializer_list>
#include <numbers>
#include <numeric>

namespace sahl {

namespace {

constexpr double per_mm2 = 1e-6; // of W/m²
constexpr double spot_to_mean =
    30.0; // peak over mean from which on a picture is drawn with a logarithmic scale

/// A table of numbers; throws where it cannot be written.
class Csv {
  public:
    Csv(std::filesystem::path file, char const* header)
        : file_(std::move(file)), out_(file_, std::ios::binary) {
        out_ << header << '\n';
    }
    void row(std::initializer_list<double> numbers) {
        char const* separator = "";
        for (double const x : numbers) {
            char text[40];
            auto const end = std::to_chars(text, text + sizeof text, x).ptr;
            (out_ << separator).write(text, end - text);
            separator = ",";
        }
        out_ << '\n';
    }
    void close() {
        if (!out_.flush())
            throw InputError(file_.string(), "cannot be written", "see that there is room on the disk");
    }

  private:
    std::filesystem::path file_;
    std::ofstream out_;
};

std::string picture(DetectorRecord const& record, std::filesystem::path const& folder,
                    std::string const& name, std::string const& title) {
    DetectorSpec const& spec = record.spec();
    std::vector<double> const field = record.irradiance();
    Image image{spec.columns, spec.rows, 1, {}};
    for (double const irradiance : field)
        image.pixels.push_back(static_cast<float>(irradiance * per_mm2));
    write_image(folder / (name + ".exr"), image,
                {{"title", title}, {"unit", "W/mm2"}, {"detector", spec.name}});
    Csv table(folder / (name + ".csv"), "x_mm,y_mm,irradiance_W_per_mm2");
    for (std::uint32_t row = 0; row < spec.rows; ++row)
        for (std::uint32_t column = 0; column < spec.columns; ++column) {
            double const x = ((column + 0.5) / spec.columns - 0.5) * spec.size.x;
            double const y = (0.5 - (row + 0.5) / spec.rows) * spec.size.y;
            table.row({x * 1e3, y * 1e3, field[std::size_t{row} * spec.columns + column] * per_mm2});
        }
    table.close();
    double const peak = std::max(record.peak() * per_mm2, 1e-300);
    double const mean =
        std::accumulate(field.begin(), field.end(), 0.0) / static_cast<double>(field.size()) * per_mm2;
    double const decades = peak > spot_to_mean * mean ? 4.0 : 0.0;
    write_image(folder / (name + ".png"), false_colour(image, peak, decades, spec.name, "W/mm\xC2\xB2",
                                                       spec.size.x * 1e3, spec.size.y * 1e3));
    return name + ".png";
}

/// A row for each bin; the EXR has the rings from the top down and the sectors from the left.
void write_far_field(DetectorRecord const& record, std::filesystem::path const& file,
                     std::string const& title) {
    FarField const& far = record.far_field()->far();
    std::vector<double> const powers = record.far_field()->powers(),
                              intensities = record.far_field()->intensities();
    Csv table(file.string() + ".csv",
              "angle_from_deg,angle_to_deg,azimuth_from_deg,azimuth_to_deg,power_W,intensity_W_per_sr");
    Image image{far.sectors, far.rings, 1, {}};
    double const ring = far.largest * (180.0 / std::numbers::pi) / far.rings, sector = 360.0 / far.sectors;
    for (std::size_t i = 0; i < powers.size(); ++i) {
        std::size_t const ring_number = i / far.sectors, sector_number = i % far.sectors;
        auto const r = static_cast<double>(ring_number), s = static_cast<double>(sector_number);
        table.row({r * ring, (r + 1.0) * ring, s * sector, (s + 1.0) * sector, powers[i], intensities[i]});
        image.pixels.push_back(static_cast<float>(intensities[i]));
    }
    table.close();
    write_image(file.string() + ".exr", image,
                {{"title", title}, {"unit", "W/sr"}, {"detector", record.spec().name}});
}

void write_spectrum(DetectorRecord const& record, std::filesystem::path const& file,
                    std::vector<double> const& wavelengths) {
    Csv table(file, "wavelength_nm,power_W");
    std::vector<std::size_t> order(wavelengths.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return wavelengths[a] < wavelengths[b]; });
    for (std::size_t const i : order)
        table.row({wavelengths[i] * 1e9, record.by_wavelength()[i].power.value(record.unit())});
    table.close();
}

void write_spot(DetectorRecord const& record, std::filesystem::path const& file) {
    Csv table(file, "share,radius_mm");
    std::vector<double> const radii = record.encircled();
    for (std::size_t i = 0; i < radii.size(); ++i)
        table.row({static_cast<double>(i + 1) / 100.0, radii[i] * 1e3});
    table.close();
}

void write_optical_path(DetectorRecord const& record, std::filesystem::path const& file) {
    Csv table(file, "from_mm,to_mm,power_W");
    Histogram const histogram = record.optical_paths();
    double const width = (histogram.to - histogram.from) / static_cast<double>(histogram.powers.size());
    for (std::size_t i = 0; i < histogram.powers.size(); ++i) {
        double const from = histogram.from + width * static_cast<double>(i);
        table.row({from * 1e3, (from + width) * 1e3, histogram.powers[i]});
    }
    table.close();
}

} // namespace

std::string detector_file_name(std::string name) {
    std::replace_if(
        name.begin(), name.end(),
        [](unsigned char c) {
            return c < 0x20 ||
                   std::string_view("/\\:*?\"<>|").find(static_cast<char>(c)) != std::string_view::npos;
        },
        '_');
    return name;
}

std::string write_detector_files(DetectorRecord const& record, std::filesystem::path const& folder,
                                 std::string const& title, std::vector<double> const& wavelengths) {
    std::filesystem::create_directories(folder);
    DetectorSpec const& spec = record.spec();
    std::string const name = detector_file_name(spec.name);
    if (spec.spot)
        write_spot(record, folder / (name + ".spot.csv"));
    if (record.far_field())
        write_far_field(record, folder / (name + ".far_field"), title);
    if (spec.spectrum)
        write_spectrum(record, folder / (name + ".spectrum.csv"), wavelengths);
    if (spec.path_bins > 0)
        write_optical_path(record, folder / (name + ".optical_path.csv"));
    return spec.kind == DetectorKind::rectangle ? picture(record, folder, name, title) : std::string();
}

} // namespace sahl

// In: nothing. Out: a folder that vanishes, a small header, rows with every kind of value, a written log.
#pragma once

#include "record/ray_log.h"

#include <unistd.h>

#include <atomic>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>

namespace sample {

class Folder {
  public:
    Folder() {
        static std::atomic<int> count = 0;
        path = std::filesystem::temp_directory_path() /
               ("sahl-record-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
        std::filesystem::create_directories(path);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    std::filesystem::path path;
};

inline std::string bytes_of(std::filesystem::path const& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline sahl::LogHeader header() {
    sahl::LogHeader header;
    header.program = "sahl test";
    header.title = "Ein Prisma bei 60°";
    header.experiment_text =
        "title = \"x\"\n# " + std::string(200000, 'e'); // more than an attribute holds by itself
    header.options_json = R"({"command": "trace"})";
    header.experiment_sha256 = "00ff";
    header.seed = 0xffff'ffff'ffff'fff0;
    header.sources = {"laser", "lamp"};
    header.source_power_W = {1.0, 0.25};
    header.source_first_ray = {0, 1000, 1000000};
    header.surfaces = {"prism.left", "odd, \"name\"", "bildschirm.fläche"};
    header.media = {"air", "N-BK7"};
    header.models = {};
    header.wavelengths_m = {486.1327 * 1e-9, 587.5618 * 1e-9};
    header.refractive_index = {1.0, 1.0, 1.5223, 1.5168};
    return header;
}

/// Rows of `rays` rays, numbered 0, stride, 2·stride …, of one to four segments each, with values all over
/// their range.
inline std::vector<sahl::Segment> rows(std::size_t rays, std::uint64_t stride = 1) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    std::vector<sahl::Segment> rows;
    for (std::size_t ray = 0; ray < rays; ++ray)
        for (std::uint32_t index = 0; index <= random() % 4; ++index) {
            sahl::Segment s;
            s.ray = ray * stride;
            s.index = index;
            s.parent = static_cast<std::int32_t>(index) - 1;
            s.depth = static_cast<std::uint16_t>(index == 3 ? 65535 : index);
            s.born = static_cast<sahl::Event>(1 + random() % 13);
            s.ended = static_cast<sahl::Event>(1 + random() % 13);
            s.surface = static_cast<std::int32_t>(random() % 4) - 1;
            s.primitive = static_cast<std::int32_t>(random() % 1000000) - 1;
            s.medium = static_cast<std::uint16_t>(random() % 2);
            s.source = s.ray < 1000 ? 0 : 1;
            s.wavelength = (ray % 2 != 0 ? 486.1327 : 587.5618) * 1e-9;
            s.origin = {any(random), 1e-9 * any(random), 1e6 * any(random)};
            s.direction = {any(random), any(random), any(random)};
            s.length = random() % 5 == 0 ? std::numeric_limits<double>::infinity() : std::abs(any(random));
            s.optical_path = std::isinf(s.length) ? s.length : 2.0 * std::abs(any(random));
            s.power_start = std::abs(any(random));
            s.power_end = s.power_start * std::abs(any(random));
            rows.push_back(s);
        }
    return rows;
}

inline std::filesystem::path write(Folder const& folder, std::vector<sahl::Segment> const& rows,
                                   std::size_t portion = SIZE_MAX, char const* name = "rays.h5",
                                   sahl::RayLogOptions const& options = {}) {
    sahl::RayLogWriter log(folder.path / name, header(), options);
    for (std::size_t done = 0; done < rows.size();) {
        std::size_t const count = std::min(portion, rows.size() - done);
        log.append(std::span(rows).subspan(done, count));
        done += count;
    }
    log.close();
    return folder.path / name;
}

} // namespace sample

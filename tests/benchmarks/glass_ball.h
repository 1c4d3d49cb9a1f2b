// In: a number of rays. Out: a glass ball that they meet, exact or of triangles, and what a log says of it; a
// plain write to compare with.
#pragma once

#include "record/ray_log.h"
#include "run/run.h"
#include "support/lab.h"
#include "support/meshes.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sahl::bench {

struct Seconds {
    double wall = 0.0, cpu = 0.0;
};

/// Of the whole process.
inline Seconds now() {
    timespec cpu{}, wall{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
    clock_gettime(CLOCK_MONOTONIC, &wall);
    auto const seconds = [](timespec const& t) {
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    };
    return {seconds(wall), seconds(cpu)};
}

struct Timing {
    std::vector<double> wall, cpu;

    void time(std::function<void()> const& action) {
        Seconds const start = now();
        action();
        Seconds const end = now();
        wall.push_back(end.wall - start.wall);
        cpu.push_back(end.cpu - start.cpu);
    }
};

/// 224 circles of latitude by 224 of longitude: 100 000 triangles.
inline TriangleSoup ball_of_triangles(double radius) {
    constexpr std::uint32_t bands = 224, around = 224;
    TriangleSoup soup;
    soup.face_names = {"surface"};
    soup.positions = {{0.0, 0.0, radius}, {0.0, 0.0, -radius}};
    for (std::uint32_t i = 1; i < bands; ++i)
        for (std::uint32_t j = 0; j < around; ++j) {
            double const u = std::numbers::pi * i / bands, v = 2.0 * std::numbers::pi * j / around;
            soup.positions.push_back(
                radius * dvec3(std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u)));
        }
    auto const at = [&](std::uint32_t i, std::uint32_t j) { return 2 + (i - 1) * around + j % around; };
    for (std::uint32_t j = 0; j < around; ++j) {
        add_triangle(soup, 0, at(1, j), at(1, j + 1));
        add_triangle(soup, 1, at(bands - 1, j + 1), at(bands - 1, j));
        for (std::uint32_t i = 1; i + 1 < bands; ++i) {
            add_triangle(soup, at(i, j), at(i + 1, j), at(i + 1, j + 1));
            add_triangle(soup, at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return soup;
}

inline Scene glass_ball(bool mesh, std::uint64_t rays) {
    std::string const text =
        std::string("[trace]\nmin_power = 1e-4\n") +
        (mesh ? ""
              : "[[object]]\nname = \"ball\"\nshape = {sphere = {radius_mm = 5}}\nmedium = \"glass\"\n") +
        "[medium]\nglass = {n = 1.5}\n[[source]]\nname = \"beam\"\nbeam = {from_mm = [0, 0, -10], toward = "
        "[0, 0, 1], radius_mm = 4.99, pattern = \"hexagonal\", rays = " +
        std::to_string(rays) + "}\n";
    Scene scene = build_scene(read_experiment(parse_toml(text, "benchmark.toml"), "benchmark.toml"));
    if (!mesh)
        return scene;
    MediumId const glass{static_cast<std::uint32_t>(scene.media.size())};
    scene.media.push_back({"glass", ConstantIndex{1.5}, {}, {}});
    return with_meshes(std::move(scene),
                       {{"ball", std::make_shared<Mesh const>(make_mesh(ball_of_triangles(5e-3))), glass}});
}

inline LogHeader header_of(Scene const& scene, Emission const& emission) {
    LogHeader header;
    header.program = program_name();
    header.sources = {"beam"};
    header.source_power_W = {1.0};
    header.source_first_ray = emission.first_rays();
    for (Face const& face : scene.faces)
        header.surfaces.push_back(face.name);
    for (Medium const& medium : scene.media) {
        header.media.push_back(medium.name);
        header.refractive_index.push_back(1.0);
    }
    header.wavelengths_m = {587.6e-9};
    return header;
}

/// Buffered, and brought to the disk as a log is.
inline void plain_write(std::filesystem::path const& file, std::uint64_t bytes) {
    static std::vector<char> const buffer(1 << 20, 'x');
    int const out = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    while (bytes > 0) {
        auto const done = ::write(out, buffer.data(), std::min<std::uint64_t>(bytes, buffer.size()));
        if (done <= 0)
            std::abort();
        bytes -= static_cast<std::uint64_t>(done);
    }
    ::fsync(out);
    ::close(out);
}

/// Makes the folder anew; nothing of before is left to write when it returns.
inline void empty(std::filesystem::path const& folder) {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    ::sync();
}

inline std::uint64_t bytes_in(std::filesystem::path const& folder) {
    std::uint64_t sum = 0;
    for (auto const& entry : std::filesystem::recursive_directory_iterator(folder))
        sum += entry.is_regular_file() ? entry.file_size() : 0;
    return sum;
}

} // namespace sahl::bench

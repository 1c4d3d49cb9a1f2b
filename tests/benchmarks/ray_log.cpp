// Figures, never asserted: what a log of every segment costs. Rays into a glass ball, full split to 1e-4: log
// off, log on, compressed, and a plain buffered write of the same bytes, brought to the disk as the log is;
// one after another in each round, medians of all rounds. Wall-clock and CPU seconds.
// usage: ray_log [RAYS [ROUNDS [FOLDER]]]
#include "record/ray_log.h"
#include "run/run.h"
#include "support/lab.h"
#include "support/meshes.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <unistd.h>
#include <vector>

namespace {

using namespace sahl;
namespace fs = std::filesystem;

struct Seconds {
    double wall = 0.0, cpu = 0.0;
};

Seconds now() {
    timespec cpu{}, wall{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
    clock_gettime(CLOCK_MONOTONIC, &wall);
    auto const seconds = [](timespec const& t) {
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    };
    return {seconds(wall), seconds(cpu)};
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
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
TriangleSoup ball_of_triangles(double radius) {
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
        bench::add_triangle(soup, 0, at(1, j), at(1, j + 1));
        bench::add_triangle(soup, 1, at(bands - 1, j + 1), at(bands - 1, j));
        for (std::uint32_t i = 1; i + 1 < bands; ++i) {
            bench::add_triangle(soup, at(i, j), at(i + 1, j), at(i + 1, j + 1));
            bench::add_triangle(soup, at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return soup;
}

Scene scene_of(bool mesh, std::uint64_t rays) {
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
    return bench::with_meshes(
        std::move(scene),
        {{"ball", std::make_shared<Mesh const>(make_mesh(ball_of_triangles(5e-3))), glass}});
}

LogHeader header_of(Scene const& scene, Emission const& emission) {
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

void plain_write(fs::path const& file, std::uint64_t bytes) {
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

std::uint64_t bytes_in(fs::path const& folder) {
    std::uint64_t sum = 0;
    for (auto const& entry : fs::recursive_directory_iterator(folder))
        sum += entry.is_regular_file() ? entry.file_size() : 0;
    return sum;
}

void measure(char const* name, bool mesh, std::uint64_t rays, int rounds, fs::path const& folder) {
    Scene const scene = scene_of(mesh, rays);
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, 1);
    TraceOptions options;
    options.min_power = 1e-4;
    std::uint64_t segments = 0, bytes = 0, compressed = 0;
    auto const trace = [&](RayLogWriter* log) {
        segments = trace_scene(scene, optics, emission, options, 0, log, {}, {}).tally.segments();
        if (log)
            log->close();
    };
    auto const empty = [&] {
        fs::remove_all(folder);
        fs::create_directories(folder);
        ::sync();
    };
    std::map<std::string, Timing> by;
    for (int round = 0; round < rounds; ++round) {
        for (bool const shrink : {false, true}) {
            empty();
            by["off"].time([&] { trace(nullptr); });
            RayLogWriter log(folder / "rays.h5", header_of(scene, emission), {shrink});
            by[shrink ? "compressed" : "on"].time([&] { trace(&log); });
            (shrink ? compressed : bytes) = bytes_in(folder);
        }
        empty();
        by["plain"].time([&] { plain_write(folder / "plain", bytes); });
    }
    fs::remove_all(folder);
    std::printf("%s: %llu rows, %.0f MB, compressed %.0f MB; medians of %d rounds\n", name,
                static_cast<unsigned long long>(segments), 1e-6 * static_cast<double>(bytes),
                1e-6 * static_cast<double>(compressed), rounds);
    double const off = median(by["off"].wall), plain = median(by["plain"].wall);
    for (char const* which : {"off", "on", "compressed", "plain"}) {
        double const wall = median(by[which].wall);
        std::printf(
            "  %-10s  %6.3f s wall  %6.3f s CPU  %6.2f M rows/s  %5.2f of log off  %5.2f of plain write\n",
            which, wall, median(by[which].cpu), 1e-6 * static_cast<double>(segments) / wall, wall / off,
            wall / plain);
    }
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
    std::uint64_t const rays = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000000;
    int const rounds = argc > 2 ? std::atoi(argv[2]) : 7;
    fs::path const folder = argc > 3 ? fs::path(argv[3]) / "sahl-benchmark-ray-log"
                                     : fs::temp_directory_path() / "sahl-benchmark-ray-log";
    measure("exact sphere", false, rays, rounds, folder);
    measure("ball of 100 000 triangles", true, rays, rounds, folder);
    return 0;
}

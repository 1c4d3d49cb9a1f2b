// Figures, never asserted: how long an OBJ file of a bumpy ball with about 900 000 triangles takes to be
// read, checked and built into a BVH that traces its first ray, part by part, and the most memory that was
// used. CPU seconds of all threads, median of several rounds; the file is written into a temporary folder
// first.
#include "geometry/bvh.h"
#include "scene/read_obj.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <sys/resource.h>

namespace {

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Rings of `2 * rings` vertices between two poles: 4 rings² − 4 rings triangles, numbers as exporters write
/// them.
void write_ball(std::filesystem::path const& path, int rings) {
    std::ofstream out(path);
    int const columns = 2 * rings;
    char line[100];
    auto const vertex = [&](double theta, double phi) {
        double const r = 10.0 + 0.3 * std::sin(9.0 * theta) * std::cos(7.0 * phi) * std::sin(theta);
        out.write(line,
                  std::snprintf(line, sizeof line, "v %.6f %.6f %.6f\n", r * std::sin(theta) * std::cos(phi),
                                r * std::sin(theta) * std::sin(phi), r * std::cos(theta)));
    };
    auto const face = [&](int a, int b, int c) {
        out.write(line, std::snprintf(line, sizeof line, "f %d %d %d\n", a, b, c));
    };
    auto const at = [&](int ring, int column) { return 2 + (ring - 1) * columns + column % columns; };
    double const pi = std::acos(-1.0);
    vertex(0.0, 0.0);
    for (int i = 1; i < rings; ++i)
        for (int j = 0; j < columns; ++j)
            vertex(pi * i / rings, 2.0 * pi * j / columns);
    vertex(pi, 0.0);
    int const south = 2 + (rings - 1) * columns;
    for (int j = 0; j < columns; ++j) {
        face(1, at(1, j), at(1, j + 1));
        for (int i = 1; i < rings - 1; ++i) {
            face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
        face(south, at(rings - 1, j + 1), at(rings - 1, j));
    }
}

} // namespace

int main(int argc, char** argv) {
    int const rings = argc > 1 ? std::atoi(argv[1]) : 475;
    std::filesystem::path const folder =
        std::filesystem::temp_directory_path() /
        ("sahl_load_obj_" + std::to_string(std::chrono::steady_clock::now().time_since_epoch().count()));
    std::filesystem::create_directories(folder);
    std::filesystem::path const path = folder / "ball.obj";
    write_ball(path, rings);

    std::array<std::vector<double>, 4> parts;
    std::size_t triangles = 0;
    for (int round = 0; round < 5; ++round) {
        double const start = cpu_seconds();
        sahl::Model const model = sahl::read_obj(path);
        double const read = cpu_seconds();
        auto const mesh = std::make_shared<sahl::Mesh const>(sahl::make_mesh(model.meshes[0].soup));
        triangles = mesh->soup.triangles.size();
        double const checked = cpu_seconds();
        std::vector<sahl::PlacedGeometry> geometry;
        geometry.emplace_back().geometry = mesh;
        sahl::Bvh const bvh(std::move(geometry));
        sahl::NextHit const hit = bvh.next({0.1, 0.2, -50.0}, {0.0, 0.0, 1.0}, {}, {});
        double const built = cpu_seconds();
        if (hit.at_one_place.empty())
            std::printf("the ball was missed\n");
        double const times[] = {read - start, checked - read, built - checked, built - start};
        for (std::size_t i = 0; i < 4; ++i)
            parts[i].push_back(times[i]);
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("OBJ file of %.1f MB, %zu triangles; CPU seconds, median of 5\n",
                1e-6 * static_cast<double>(std::filesystem::file_size(path)), triangles);
    char const* const names[] = {"read", "weld, orient, find shells", "BVH and first ray", "together"};
    for (std::size_t i = 0; i < 4; ++i)
        std::printf("  %-26s %6.3f s  %6.2f M triangles/s\n", names[i], median(parts[i]),
                    1e-6 * static_cast<double>(triangles) / median(parts[i]));
    std::printf("  most memory                %6.0f MB\n", static_cast<double>(usage.ru_maxrss) / 1024.0);
    std::filesystem::remove_all(folder);
    return 0;
}

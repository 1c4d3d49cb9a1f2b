// Figures, never asserted: what it takes to group the paths of a long log, and to select some of them. Rays
// into a glass ball with a mirror beside it, full split to 1e-4; CPU seconds and the most memory held. usage:
// path_groups [MILLIONS_OF_SEGMENTS [ROUNDS [FOLDER]]]
#include "record/path_groups.h"
#include "record/read_rays.h"
#include "run/run.h"
#include "support/cpu_clock.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace {

using namespace sahl;
namespace fs = std::filesystem;

std::string experiment(double millions) {
    auto const rays = static_cast<std::uint64_t>(millions * 1e6 / 15.3); // segments of a ray, about
    return "trace = {min_power = 1e-4, log = true}\n"
           "object = [{name = \"ball\", shape = {sphere = {radius_mm = 5}}, medium = \"N-SF11\"},\n"
           "  {name = \"mirror\", shape = {rectangle = {size_mm = [20, 20]}}, surface = \"m\", move_mm = [0, "
           "0, 9]}]\n"
           "surface = {m = {metal = \"silver\"}}\n"
           "source = [{name = \"beam\", beam = {from_mm = [0, 0, -10], toward = [0, 0, 1], radius_mm = 4.99, "
           "pattern = "
           "\"hexagonal\", rays = " +
           std::to_string(rays) + "}, lines = [\"d\"]}]\n";
}

void measure(char const* what, int rounds, std::function<std::string()> const& action) {
    std::vector<double> wall, cpu;
    std::string result;
    for (int round = 0; round < rounds; ++round) {
        auto const start = std::chrono::steady_clock::now();
        double const cpu_start = bench::cpu_seconds();
        result = action();
        cpu.push_back(bench::cpu_seconds() - cpu_start);
        wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    std::sort(wall.begin(), wall.end());
    std::sort(cpu.begin(), cpu.end());
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("%-34s %6.2f s wall  %6.2f s CPU  %s; %.2f GB at most so far\n", what, wall[wall.size() / 2],
                cpu[cpu.size() / 2], result.c_str(), 1024e-9 * static_cast<double>(usage.ru_maxrss));
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
    double const millions = argc > 1 ? std::atof(argv[1]) : 10.0;
    int const rounds = argc > 2 ? std::atoi(argv[2]) : 3;
    fs::path const folder =
        (argc > 3 ? fs::path(argv[3]) : fs::temp_directory_path()) / "sahl-benchmark-path-groups";
    fs::remove_all(folder);
    fs::create_directories(folder);
    std::ofstream(folder / "ball.toml") << experiment(millions);
    RunOptions options;
    options.out = folder / "out";
    run_experiment(load_experiment(folder / "ball.toml"), options);
    RayLogReader const log(folder / "out");
    std::printf("%.2f million segments of %llu rays\n", 1e-6 * static_cast<double>(log.rows()),
                static_cast<unsigned long long>(log.rays()));
    measure("reading alone", rounds, [&] {
        std::size_t rays = 0;
        read_rays(log, nullptr, [&](auto) { return ++rays > 0; });
        return std::to_string(rays) + " rays";
    });
    measure("groups above 0.001", rounds,
            [&] { return std::to_string(group_paths(log, nullptr, 1e-3).groups.size()) + " groups"; });
    auto const ghosts =
        log_filter(log.header(), "reflected(ball) >= 2 and order(hits(mirror), hits(ball))", "");
    measure("groups of selected paths", rounds,
            [&] { return std::to_string(group_paths(log, &*ghosts, 1e-3).groups.size()) + " groups"; });
    measure("room for 64 only, read twice", rounds,
            [&] { return std::to_string(group_paths(log, nullptr, 0.07, 64).groups.size()) + " groups"; });
    fs::remove_all(folder);
    return 0;
}

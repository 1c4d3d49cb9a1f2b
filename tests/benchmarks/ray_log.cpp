// Figures, never asserted: what a log of every segment costs. Rays into a glass ball, full split to 1e-4: log
// off, log on, compressed, and a plain buffered write of the same bytes, brought to the disk as the log is;
// one after another in each round, medians of all rounds. Wall-clock and CPU seconds.
// usage: ray_log [RAYS [ROUNDS [FOLDER]]]
#include "benchmarks/glass_ball.h"
#include "support/cpu_clock.h"

#include <cstdio>

namespace {

using namespace sahl;
namespace fs = std::filesystem;

void print(std::map<std::string, bench::Timing>& by, std::uint64_t segments) {
    double const off = bench::median(by["off"].wall), plain = bench::median(by["plain"].wall);
    for (char const* which : {"off", "on", "compressed", "plain"}) {
        double const wall = bench::median(by[which].wall);
        std::printf(
            "  %-10s  %6.3f s wall  %6.3f s CPU  %6.2f M rows/s  %5.2f of log off  %5.2f of plain write\n",
            which, wall, bench::median(by[which].cpu), 1e-6 * static_cast<double>(segments) / wall,
            wall / off, wall / plain);
    }
    std::printf("  log on took %.2f of the greater of 1.35 x log off and 1.1 x the plain write\n",
                bench::median(by["on"].wall) / std::max(1.35 * off, 1.1 * plain));
    std::fflush(stdout);
}

void measure(char const* name, bool mesh, std::uint64_t rays, int rounds, fs::path const& folder) {
    Scene const scene = bench::glass_ball(mesh, rays);
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
    std::map<std::string, bench::Timing> by;
    for (int round = 0; round < rounds; ++round) {
        for (bool const shrink : {false, true}) {
            bench::empty(folder);
            by["off"].time([&] { trace(nullptr); });
            RayLogWriter log(folder / "rays.h5", bench::header_of(scene, emission), {shrink});
            by[shrink ? "compressed" : "on"].time([&] { trace(&log); });
            (shrink ? compressed : bytes) = bench::bytes_in(folder);
        }
        bench::empty(folder);
        by["plain"].time([&] { bench::plain_write(folder / "plain", bytes); });
    }
    fs::remove_all(folder);
    std::printf("%s: %llu rows, %.0f MB, compressed %.0f MB; medians of %d rounds\n", name,
                static_cast<unsigned long long>(segments), 1e-6 * static_cast<double>(bytes),
                1e-6 * static_cast<double>(compressed), rounds);
    print(by, segments);
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

// Figures, never asserted: the most memory that a long log takes. Rays into a glass ball, full split to 1e-4,
// every segment of them in the log. usage: log_memory [MILLIONS_OF_ROWS [FOLDER]]; a row is 118 bytes.
#include "benchmarks/glass_ball.h"

#include <sys/resource.h>

#include <cstdio>

int main(int argc, char** argv) {
    using namespace sahl;
    namespace fs = std::filesystem;
    double const millions = argc > 1 ? std::strtod(argv[1], nullptr) : 100.0;
    fs::path const folder =
        (argc > 2 ? fs::path(argv[2]) : fs::temp_directory_path()) / "sahl-benchmark-log-memory";
    auto const most_memory_GB = [] {
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        return 1024e-9 * static_cast<double>(usage.ru_maxrss);
    };

    Scene const scene = bench::glass_ball(false, static_cast<std::uint64_t>(millions * 1e6 / 11.33) + 1);
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, 1);
    TraceOptions options;
    options.min_power = 1e-4;
    bench::empty(folder);
    double const before = most_memory_GB();
    std::uint64_t segments = 0;
    bench::Timing timing;
    timing.time([&] {
        RayLogWriter log(folder / "rays.h5", bench::header_of(scene, emission));
        segments = trace_scene(scene, optics, emission, options, 0, &log, {}, {}).tally.segments();
        log.close();
    });
    std::printf("%.2f M rows, %.2f GB, %.1f s wall, %.1f s CPU: at most %.3f GB of memory, %.3f GB before\n",
                1e-6 * static_cast<double>(segments), 1e-9 * static_cast<double>(bench::bytes_in(folder)),
                timing.wall[0], timing.cpu[0], most_memory_GB(), before);
    fs::remove_all(folder);
    return 0;
}

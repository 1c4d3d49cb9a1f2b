// Figures, never asserted: segments a second in one exact glass sphere, full split to 1e-4, one thread, log
// off; beside it a closed-form loop that does the same rays and nothing else. CPU seconds of the thread,
// median of several rounds.
#include "support/cpu_clock.h"

#include "run/run.h"
#include "trace/tracer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using sahl::bench::cpu_seconds;
using sahl::bench::median;

/// By symmetry every meeting of one ray with the sphere has the same angles: the tree is a geometric series.
std::uint64_t closed_form(double n, double height, double limit, double& sum) {
    double const cos_i = std::sqrt(1.0 - height * height), sin_t = height / n,
                 cos_t = std::sqrt(1.0 - sin_t * sin_t);
    double const r_s = (cos_i - n * cos_t) / (cos_i + n * cos_t),
                 r_p = (n * cos_i - cos_t) / (n * cos_i + cos_t);
    double const r = 0.5 * (r_s * r_s + r_p * r_p), t = 1.0 - r;
    std::uint64_t segments = 2; // the ray, and what it reflects outside
    sum += r;
    for (double inside = t; inside >= limit; inside *= r) {
        segments += 2;
        sum += inside * t;
    }
    return segments + 1; // the branch that is cut
}

} // namespace

int main(int argc, char** argv) {
    std::uint64_t const rays = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 400000;
    std::string const text =
        "[trace]\nmin_power = 1e-4\n[[object]]\nname = \"ball\"\nshape = {sphere = {radius_mm = 5}}\n"
        "medium = \"glass\"\n[medium]\nglass = {n = 1.5}\n[[source]]\nname = \"beam\"\nbeam = {from_mm = [0, "
        "0, "
        "-10], toward = [0, 0, 1], radius_mm = 4.999, pattern = \"hexagonal\", rays = " +
        std::to_string(rays) + "}\n";
    sahl::Experiment const experiment =
        sahl::read_experiment(sahl::parse_toml(text, "benchmark.toml"), "benchmark.toml");
    sahl::Scene const scene = sahl::build_scene(experiment);
    sahl::WavelengthTable const optics(scene);
    sahl::Emission const emission(scene.sources, optics, 1);
    sahl::TraceContext const context{scene, optics, emission, experiment.trace, sahl::power_unit(emission),
                                     0};

    std::vector<double> product, bare;
    std::uint64_t segments = 0, bare_segments = 0;
    double sum = 0.0;
    for (int round = 0; round < 7; ++round) {
        double const start = cpu_seconds();
        segments = 0;
        for (std::uint64_t first = 0; first < rays; first += sahl::rays_per_batch)
            segments +=
                trace_batch(context, first, std::min(sahl::rays_per_batch, rays - first)).tally.segments();
        double const middle = cpu_seconds();
        bare_segments = 0;
        for (std::uint64_t i = 0; i < rays; ++i) {
            sahl::Ray const ray = emission.ray(i);
            bare_segments += closed_form(1.5, std::hypot(ray.origin.x, ray.origin.y) / 5e-3, 1e-4, sum);
        }
        double const end = cpu_seconds();
        product.push_back(static_cast<double>(segments) / (middle - start));
        bare.push_back(static_cast<double>(bare_segments) / (end - middle));
    }
    std::printf("exact glass sphere, %llu rays, split to 1e-4, one thread, median of 7\n",
                static_cast<unsigned long long>(rays));
    std::printf("  sahl         %10llu segments  %6.2f M/s\n", static_cast<unsigned long long>(segments),
                median(product) * 1e-6);
    std::printf("  closed form  %10llu segments  %6.2f M/s   (no directions, no sums; %g)\n",
                static_cast<unsigned long long>(bare_segments), median(bare) * 1e-6, sum);
    return 0;
}

// Figures, never asserted: a glass ball of 100 820 triangles, full split to 1e-4, log off, beside the bare
// loop on the same rays; and the next hit alone, as found by the mesh, by the scene and by the bare loop from
// the same places. One thread; CPU seconds of the thread, the two in turn, median of several rounds.
#include "bare_loop.h"
#include "support/cpu_clock.h"
#include "support/lab.h"
#include "support/meshes.h"

#include "geometry/mesh_tree.h"
#include "run/trace_scene.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr int rounds = 7;

void whole_trees(Scene const& scene, BareLoop& bare, Experiment const& experiment) {
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, 1);
    TraceContext const context{scene, optics, emission, experiment.trace, power_unit(emission), 0};
    std::vector<double> ours, theirs, ratio;
    std::uint64_t segments = 0, bare_segments = 0;
    double escaped = 0.0;
    for (int round = 0; round < rounds; ++round) {
        double const start = cpu_seconds();
        segments = 0;
        for (std::uint64_t first = 0; first < emission.rays(); first += rays_per_batch)
            segments += trace_batch(context, first, std::min(rays_per_batch, emission.rays() - first))
                            .tally.segments();
        double const middle = cpu_seconds();
        bare_segments = 0;
        for (std::uint64_t i = 0; i < emission.rays(); ++i) {
            Ray const ray = emission.ray(i);
            bare_segments += bare.trace(ray.origin, ray.direction, 1.5, experiment.trace.min_power,
                                        experiment.trace.max_depth, escaped);
        }
        double const end = cpu_seconds();
        ours.push_back(static_cast<double>(segments) / (middle - start));
        theirs.push_back(static_cast<double>(bare_segments) / (end - middle));
        ratio.push_back(ours.back() / theirs.back());
    }
    std::printf(
        "  whole trees: sahl %9llu segments %6.2f M/s   bare loop %9llu segments %6.2f M/s   ratio %.2f\n",
        static_cast<unsigned long long>(segments), median(ours) * 1e-6,
        static_cast<unsigned long long>(bare_segments), median(theirs) * 1e-6, median(ratio));
}

/// CPU seconds a call, of each, the median of several rounds in turn.
template <class... Way>
std::vector<double> in_turn(std::vector<Segment> const& paths, double& sum, Way const&... ways) {
    std::vector<std::vector<double>> seconds(sizeof...(ways));
    for (int round = 0; round < rounds; ++round) {
        auto* of_way = seconds.data();
        auto const time = [&](auto const& way) {
            double const start = cpu_seconds();
            for (Segment const& s : paths)
                sum += way(s);
            (of_way++)->push_back((cpu_seconds() - start) / static_cast<double>(paths.size()));
        };
        (time(ways), ...);
    }
    std::vector<double> medians;
    for (auto const& of_way : seconds)
        medians.push_back(median(of_way));
    return medians;
}

/// The next hit from every place of many paths: in the mesh alone, in the scene, by the bare loop.
void next_hits(Scene const& scene, MeshTree const& tree, BareLoop const& bare, Experiment const& experiment) {
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, 1);
    TraceContext const context{scene, optics, emission, experiment.trace, power_unit(emission), 1};
    std::vector<Segment> const paths =
        trace_batch(context, 0, std::min<std::uint64_t>(emission.rays(), 50000)).log.segments;
    ShellSet const outside;
    ShellSet inside;
    inside.insert({0});
    auto const set = [&](Segment const& s) -> ShellSet const& { return s.medium == 1 ? inside : outside; };
    double sum = 0.0;
    auto const ns = in_turn(
        paths, sum,
        [&](Segment const& s) {
            auto const answer = tree.next(s.origin, s.direction, {set(s), {0}}, {0.0, INFINITY}, 1e-16);
            return answer.crossing ? answer.crossing->t : 0.0;
        },
        [&](Segment const& s) { return scene.bvh->next(s.origin, s.direction, set(s), {}).blur; },
        [&](Segment const& s) {
            auto const hit = bare.next(s.origin, s.direction);
            return hit ? hit->t : 0.0;
        });
    std::printf(
        "  next hit: mesh %.0f ns, ratio %.2f   scene %.0f ns, ratio %.2f   bare loop %.0f ns   (%g)\n",
        ns[0] * 1e9, ns[0] / ns[2], ns[1] * 1e9, ns[1] / ns[2], ns[2] * 1e9, sum);
}

} // namespace

int main(int argc, char** argv) {
    std::uint64_t const rays = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100000;
    auto const frequency = static_cast<std::uint32_t>(argc > 2 ? std::atoi(argv[2]) : 71);
    for (Pattern const pattern : {Pattern::hexagonal, Pattern::random}) {
        Lab lab;
        MediumId const glass = lab.medium(1.5);
        lab.experiment.trace.min_power = 1e-4;
        Beam beam{};
        beam.from = {0.0, 0.0, -10e-3};
        beam.toward = {0.0, 0.0, 1.0};
        beam.up = {0.0, 1.0, 0.0};
        beam.radius = 4.99e-3;
        beam.pattern = pattern;
        beam.rays = rays;
        lab.source(beam);
        auto const mesh = std::make_shared<Mesh const>(make_mesh(geodesic_soup(5e-3, frequency)));
        Scene const scene = with_meshes(build_scene(lab.experiment), {{"ball", mesh, glass, Affine{}, 0}});
        MeshTree const tree(mesh);
        BareLoop bare(*mesh);
        std::printf("glass ball of %zu triangles, %llu rays in %s order\n", mesh->soup.triangles.size(),
                    static_cast<unsigned long long>(rays), pattern == Pattern::random ? "random" : "rows");
        whole_trees(scene, bare, lab.experiment);
        next_hits(scene, tree, bare, lab.experiment);
    }
    return 0;
}

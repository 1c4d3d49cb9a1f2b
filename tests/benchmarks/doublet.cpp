// Figures, never asserted: a cemented doublet of two meshes of 100 000 triangles in all. What it costs to
// find the next hit, from every place of many paths through it: with the contact, with a gap of 0.1 mm in its
// place, and by the bare loop, which meets the cemented face as two. One thread; CPU seconds, in turn, median
// of several rounds.
#include "bare_loop.h"
#include "support/cpu_clock.h"
#include "support/lab.h"
#include "support/lathe.h"

#include "run/trace_scene.h"

#include <array>
#include <cstdio>

using namespace sahl;
using namespace sahl::bench;

namespace {

struct Doublet {
    std::shared_ptr<Mesh const> crown, flint;
    Scene scene;
    std::vector<Segment> paths;

    explicit Doublet(double gap) {
        Lab lab;
        MediumId const n1 = lab.medium(1.5168), n2 = lab.medium(1.6200);
        lab.experiment.trace.min_power = 1e-3;
        Beam beam{};
        beam.from = {0.0, 0.0, -20e-3};
        beam.toward = {0.0, 0.0, 1.0};
        beam.up = {0.0, 1.0, 0.0};
        beam.radius = 9e-3;
        beam.pattern = Pattern::hexagonal;
        beam.rays = 20000;
        lab.source(beam);
        constexpr std::uint32_t rings = 64, sectors = 195; // 4 · 64 · 195 in each lens, less at the tips
        auto const mesh = [](TriangleSoup soup, double shift) {
            for (dvec3& p : soup.positions)
                p.z += shift;
            return std::make_shared<Mesh const>(make_mesh(std::move(soup)));
        };
        crown = mesh(lens_soup(60e-3, -45e-3, 6e-3, 10e-3, rings, sectors), 0.0);
        flint = mesh(lens_soup(-45e-3, -130e-3, 3e-3, 10e-3, rings, sectors), 6e-3 + gap);
        scene = with_meshes(build_scene(lab.experiment),
                            {{"crown", crown, n1, Affine{}, 0}, {"flint", flint, n2, Affine{}, 0}});
        WavelengthTable const optics(scene);
        Emission const emission(scene.sources, optics, 1);
        TraceContext const context{scene, optics, emission, lab.experiment.trace, power_unit(emission), 1};
        paths = trace_batch(context, 0, emission.rays()).log.segments;
    }
    /// CPU seconds a hit.
    double seconds(double& sum) const {
        std::array<ShellSet, 3> inside; // by medium: air, crown, flint
        inside[1].insert({0});
        inside[2].insert({1});
        double const start = cpu_seconds();
        for (Segment const& s : paths)
            sum += scene.bvh->next(s.origin, s.direction, inside[s.medium], {}).blur;
        return (cpu_seconds() - start) / static_cast<double>(paths.size());
    }
};

} // namespace

int main() {
    Doublet const cemented(0.0), apart(0.1e-3);
    Mesh const both = make_mesh(together(cemented.crown->soup, cemented.flint->soup));
    BareLoop const bare(both);
    std::vector<double> touching, gap, plain, ratio;
    double sum = 0.0;
    for (int round = 0; round < 7; ++round) {
        touching.push_back(cemented.seconds(sum));
        gap.push_back(apart.seconds(sum));
        double const start = cpu_seconds();
        for (Segment const& s : cemented.paths)
            if (auto const hit = bare.next(s.origin, s.direction))
                sum += hit->t;
        plain.push_back((cpu_seconds() - start) / static_cast<double>(cemented.paths.size()));
        ratio.push_back(touching.back() / plain.back());
    }
    std::printf(
        "cemented doublet of %zu triangles, %zu places: touching %.0f ns   0.1 mm apart %.0f ns   bare loop "
        "%.0f ns   ratio %.2f   (%g)\n",
        both.soup.triangles.size(), cemented.paths.size(), median(touching) * 1e9, median(gap) * 1e9,
        median(plain) * 1e9, median(ratio), sum);
    return 0;
}

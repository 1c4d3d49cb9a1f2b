// Figures, never asserted: what it costs to find where a ray meets each exact shape, against the sphere. One
// shape in the scene, rays that hit it: from outside, and on through it from where they came in. CPU seconds
// of the thread; each round measures the sphere beside the shape, and the medians of rounds are printed.
#include "support/cpu_clock.h"
#include "support/dice.h"

#include "geometry/bvh.h"

#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace sahl;
using sahl::bench::cpu_seconds;
using sahl::bench::Dice;
using sahl::bench::median;

namespace {

double const mm = 1e-3, deg = std::numbers::pi / 180.0;

std::vector<std::pair<std::string, Shape>> shapes() {
    auto const lens = [](double conic, std::vector<double> const& terms) {
        return Lens{20 * mm, -20 * mm, 5 * mm, 12 * mm, conic, conic, terms, terms};
    };
    return {
        {"sphere", Sphere{5 * mm}},
        {"box", Box{dvec3(8 * mm)}},
        {"cylinder", Cylinder{4 * mm, 9 * mm}},
        {"cone", Cone{5 * mm, 2 * mm, 8 * mm}},
        {"prism", Prism{60 * deg, 10 * mm, 8 * mm}},
        {"corner_cube", CornerCube{8 * mm}},
        {"quadric: ellipsoid", QuadricBody{{1, 2, 1.5, 0, 0, 0, 0, 0, 0, -2.5e-5}, dvec3(12 * mm)}},
        {"quadric: hyperboloid, clipped", QuadricBody{{1, 1, -0.5, 0, 0, 0, 0, 0, 0, -9e-6}, dvec3(9 * mm)}},
        {"lens, spherical", lens(0.0, {})},
        {"lens, conic (−0.6)", lens(-0.6, {})},
        {"lens, conic (−2)", lens(-2.0, {})},
        {"lens, one aspheric term", lens(0.0, {20.0})},
        {"lens, conic and three terms", lens(-0.6, {20.0, 1e5, -1e9})},
        {"rectangle", Rectangle{dvec2(8 * mm)}},
        {"disk", Disk{5 * mm, 1 * mm}},
        {"conic_mirror, paraboloid", ConicMirror{20 * mm, -1.0, 10 * mm}},
        {"conic_mirror, hyperboloid with hole", ConicMirror{20 * mm, -3.0, 10 * mm, 2 * mm}}};
}

struct Ray {
    dvec3 origin, direction;
};

/// One shape, and rays that meet it: from outside, and from where they came in.
struct Target {
    Bvh bvh;
    std::vector<Ray> outside, inside;
    std::vector<double> ns_in, ns_out, by_in, by_out;
    ShellSet in;

    static PlacedGeometry placed(Shape const& shape) { return {shape, {}, {0}, {0}, false, false}; }

    Target(Shape const& shape, std::size_t rays) : bvh({placed(shape)}) {
        Dice dice(7);
        in.insert({0});
        auto const [low, high] = bvh.bounds();
        dvec3 const middle = 0.5 * (low + high);
        double const reach = length(high - low);
        while (outside.size() < rays) {
            dvec3 const from = middle + 2.0 * reach * dice.direction();
            dvec3 const to(dice.between(low.x, high.x), dice.between(low.y, high.y),
                           dice.between(low.z, high.z));
            Ray const ray{from, normalize(to - from)};
            NextHit const hit = bvh.next(ray.origin, ray.direction, {}, {});
            if (hit.at_one_place.empty())
                continue;
            outside.push_back(ray);
            if (!hit.at_one_place[0].open)
                inside.push_back({hit.at_one_place[0].point, ray.direction});
        }
    }

    double measure(std::vector<Ray> const& rays, ShellSet const& where, double& sum) const {
        double const start = cpu_seconds();
        for (Ray const& ray : rays) {
            NextHit const hit = bvh.next(ray.origin, ray.direction, where, {});
            sum += hit.at_one_place.empty() ? 0.0 : hit.at_one_place[0].t;
        }
        return (cpu_seconds() - start) / static_cast<double>(rays.size()) * 1e9;
    }
};

} // namespace

int main(int argc, char** argv) {
    std::size_t const rays = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 20000;
    int const rounds = argc > 2 ? std::atoi(argv[2]) : 9;
    std::vector<std::pair<std::string, Shape>> const all = shapes();
    std::vector<Target> targets;
    for (auto const& [name, shape] : all)
        targets.emplace_back(shape, rays);
    double sum = 0.0;
    for (int round = 0; round < rounds; ++round)
        for (Target& target : targets) {
            double const sphere_in = targets[0].measure(targets[0].outside, {}, sum);
            double const sphere_out = targets[0].measure(targets[0].inside, targets[0].in, sum);
            target.ns_in.push_back(target.measure(target.outside, {}, sum));
            target.by_in.push_back(target.ns_in.back() / sphere_in);
            if (target.inside.empty())
                continue;
            target.ns_out.push_back(target.measure(target.inside, target.in, sum));
            target.by_out.push_back(target.ns_out.back() / sphere_out);
        }
    std::printf("next hit of a lone shape, %zu rays, one thread, medians of %d (%g)\n\n", rays, rounds, sum);
    std::printf("| shape | from outside, ns | against the sphere | from inside, ns | against the sphere |\n");
    std::printf("|---|---|---|---|---|\n");
    for (std::size_t i = 0; i < all.size(); ++i) {
        Target const& t = targets[i];
        std::printf("| %s | %.0f | %.2f |", all[i].first.c_str(), median(t.ns_in), median(t.by_in));
        if (t.ns_out.empty())
            std::printf(" – | – |\n");
        else
            std::printf(" %.0f | %.2f |\n", median(t.ns_out), median(t.by_out));
    }
    return 0;
}

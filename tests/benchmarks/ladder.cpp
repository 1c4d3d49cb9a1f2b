// Figures, never asserted: a ball as float data carry it, met by each method of the ladder. The next hit from
// the places of many paths, beside the plain mesh; grazing rays that leak; what a triangle takes of memory.
#include "support/cpu_clock.h"
#include "support/curved.h"

#include "geometry/curved_tree.h"
#include "geometry/mesh_tree.h"
#include "geometry/recognise.h"
#include "math/random.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr double radius = 5e-3, rounding = 64.0 * 0x1p-52 * 8.7e-3; // as in a scene, of the ball's extent

struct Query {
    dvec3 origin, direction;
    bool inside;
};

dvec3 any_direction(std::uint64_t ray, std::uint64_t place) {
    double const z = 2.0 * uniform(7, ray, place, 0) - 1.0,
                 turn = 2.0 * std::numbers::pi * uniform(7, ray, place, 1);
    double const r = std::sqrt(1.0 - z * z);
    return {r * std::cos(turn), r * std::sin(turn), z};
}

/// Ways through the ball and back inside, as a split tree has them, most inside; `onto` puts a place of the
/// sphere on the surface that is asked.
template <class Onto>
std::vector<Query> queries(std::size_t rays, Onto const& onto) {
    std::vector<Query> list;
    for (std::size_t i = 0; i < rays; ++i) {
        double const r = 0.99 * radius * std::sqrt(uniform(3, i, 0, 0)),
                     turn = 2.0 * std::numbers::pi * uniform(3, i, 0, 1);
        dvec3 const p(r * std::cos(turn), r * std::sin(turn), -std::sqrt(radius * radius - r * r));
        list.push_back({{p.x, p.y, -2.0 * radius}, {0.0, 0.0, 1.0}, false});
        dvec3 at = p, n = normalize(p);
        double const c = -n.z, s2 = (1.0 - c * c) / 2.25;
        dvec3 d = normalize(dvec3(0.0, 0.0, 1.0) / 1.5 + (c / 1.5 - std::sqrt(1.0 - s2)) * n);
        for (int bounce = 0; bounce < 4; ++bounce) {
            list.push_back({onto(at), d, true});
            at -= 2.0 * dot(at, d) * d;
            n = normalize(at);
            d = normalize(d - 2.0 * dot(d, n) * n);
        }
    }
    return list;
}

void timing(std::shared_ptr<Mesh const> const& mesh) {
    MeshTree const plain(mesh);
    CurvedTree const quadratic(mesh, PatchKind::quadratic), fitted(mesh, PatchKind::fitted);
    auto const solid = recognise(fitted.fans());
    ShellSet in;
    in.insert({0});
    ShellSet const out;
    std::vector<Query> const list = queries(40000, [](dvec3 const& p) { return p; });
    std::vector<Query> const of_plain = queries(40000, [&](dvec3 const& p) {
        auto const c = plain.next(1.5 * p, -normalize(p), {out, {0}}, {0.0, INFINITY}, rounding).crossing;
        return c ? plain.onto(c->triangle, 1.5 * p - c->t * normalize(p)) : p;
    });
    double sum = 0.0;
    std::vector<std::vector<double>> seconds(4);
    for (int round = 0; round < 9; ++round) {
        auto const time = [&](std::size_t way, auto const& call) {
            double const start = cpu_seconds();
            for (Query const& q : way == 0 ? of_plain : list)
                sum += call(q);
            seconds[way].push_back((cpu_seconds() - start) / static_cast<double>(list.size()) * 1e9);
        };
        auto const t_of = [](auto const& answer) { return answer.crossing ? answer.crossing->t : 0.0; };
        time(0, [&](Query const& q) {
            return t_of(
                plain.next(q.origin, q.direction, {q.inside ? in : out, {0}}, {0.0, INFINITY}, rounding));
        });
        time(1, [&](Query const& q) {
            return t_of(
                quadratic.next(q.origin, q.direction, {q.inside ? in : out, {0}}, {0.0, INFINITY}, rounding));
        });
        time(2, [&](Query const& q) {
            return t_of(
                fitted.next(q.origin, q.direction, {q.inside ? in : out, {0}}, {0.0, INFINITY}, rounding));
        });
        if (solid)
            time(3, [&](Query const& q) {
                auto const c = solid->solid.next(q.origin, q.direction, q.inside, 0.0, rounding);
                return c ? c->t : 0.0;
            });
    }
    std::printf("ball of %zu triangles: next hit plain %.0f ns", mesh->soup.triangles.size(),
                median(seconds[0]));
    char const* const names[] = {"", "quadratic", "fitted", "recognised"};
    for (std::size_t way = 1; way < 4; ++way)
        if (!seconds[way].empty())
            std::printf(", %s %.0f ns = %.2f times", names[way], median(seconds[way]),
                        median(seconds[way]) / median(seconds[0]));
    std::printf(" (%g)\n  bytes a triangle beside the mesh: quadratic %.0f, fitted %.0f\n", sum,
                quadratic.bytes_per_triangle(), fitted.bytes_per_triangle());
}

void gallery(std::shared_ptr<Mesh const> const& mesh, std::uint64_t bounces) {
    ShellSet in;
    in.insert({0});
    for (PatchKind const kind : {PatchKind::quadratic, PatchKind::fitted}) {
        CurvedTree const tree(mesh, kind);
        std::uint64_t leaks = 0, recovered = 0, missed = 0, done = 0;
        for (std::uint64_t walk = 0; done < bounces; ++walk) {
            dvec3 const from = any_direction(walk, 3);
            auto const start =
                tree.next(2.0 * radius * from, -from, {{}, {0}}, {0.0, INFINITY}, rounding).crossing;
            if (!start)
                continue;
            dvec3 point = start->point;
            dvec3 d =
                normalize(perpendicular_to(start->normal, any_direction(walk, 4)) - 3e-3 * start->normal);
            for (int bounce = 0; bounce < 1000; ++bounce, ++done) {
                auto const c = tree.next(point, d, {in, {0}}, {0.0, INFINITY}, rounding).crossing;
                if (!c) {
                    ++leaks;
                    break;
                }
                recovered += c->recovered;
                point = c->point;
                d = normalize(d - 2.0 * dot(d, c->normal) * c->normal);
            }
        }
        for (std::uint64_t i = 0; i < bounces; ++i) {
            dvec3 const along = any_direction(i, 0), side = perpendicular_to(along, any_direction(i, 1));
            double const share = 0.99 + 0.009 * uniform(7, i, 2, 0);
            missed +=
                !tree.next(-0.02 * along + share * radius * side, along, {{}, {0}}, {0.0, INFINITY}, rounding)
                     .crossing;
        }
        std::printf("%s: %llu hits at 0.003 rad: %llu leaks, %llu recovered; %llu silhouette rays at 0.99 to "
                    "0.999 R: %llu missed\n",
                    kind == PatchKind::fitted ? "fitted" : "quadratic", static_cast<unsigned long long>(done),
                    static_cast<unsigned long long>(leaks), static_cast<unsigned long long>(recovered),
                    static_cast<unsigned long long>(bounces), static_cast<unsigned long long>(missed));
    }
}

} // namespace

int main(int argc, char** argv) {
    std::uint64_t const bounces = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100000;
    for (std::uint32_t const frequency : {14u, 28u, 71u})
        timing(float_ball(radius, frequency));
    gallery(float_ball(radius, 28), bounces);
    return 0;
}

// Figures, never asserted: leaks in segments inside closed meshes: generated ones, and OBJ models of the
// shared data where they are. Light is reflected inside; every now and then it is aimed at a vertex, or at a
// point of an edge.
//   leaks [SEGMENTS OF ALL MODELS TOGETHER] [MODEL.obj ...]
#include "geometry/bvh.h"
#include "optics/snell.h"
#include "scene/read_obj.h"
#include "torture/aim.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>

using namespace sahl;
using namespace sahl::bench;

namespace {

struct Count {
    std::uint64_t segments = 0, leaks = 0, recovered = 0;
};

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A brilliant of 57 facets' kind: table, crown, girdle, pavilion.
TriangleSoup diamond_soup() {
    return revolved(
        {{0.0, -0.43}, {0.2, -0.26}, {0.5, -0.02}, {0.5, 0.02}, {0.4, 0.1}, {0.28, 0.16}, {0.0, 0.16}}, 16);
}

class Walker {
  public:
    Walker(MeshRef mesh, Affine const& place, std::uint64_t seed)
        : mesh_(std::move(mesh)), place_(place), dice_(seed),
          bvh_({PlacedGeometry{mesh_, place, {0}, {0}, false, false}}) {}

    Count count(std::uint64_t segments) {
        while (count_.segments < segments)
            if (start())
                walk();
        return count_;
    }

  private:
    /// On a triangle, heading in at any angle.
    bool start() {
        OnTriangle const at = on_triangle(*mesh_, dice_, static_cast<int>(dice_.below(3)));
        dvec3 const normal = dvec3(mesh_->shells[mesh_->triangle_shell[at.triangle]].sign) * at.normal;
        origin_ = place_.point(at.point);
        direction_ = normalize(place_.vector(along_surface(normal, dice_.log_between(1e-4, 1.5), dice_)));
        inside_ = bvh_.start_at(origin_, direction_).inside;
        return !inside_.empty();
    }
    void walk() {
        for (int bounce = 0; bounce < 1000; ++bounce) {
            NextHit const hit = bvh_.next(origin_, direction_, inside_, {});
            ++count_.segments;
            count_.recovered += hit.proof == Proof::recovered;
            if (hit.proof == Proof::leak || hit.at_one_place.empty() || hit.at_one_place.front().enters) {
                ++count_.leaks;
                return;
            }
            Crossing const& c = hit.at_one_place.front();
            if (dice_.below(4) == 0 && hit.t > 1e-6) { // from half way at a vertex or an edge
                origin_ += 0.5 * hit.t * direction_;
                OnTriangle const at = on_triangle(*mesh_, dice_, 1 + static_cast<int>(dice_.below(2)));
                direction_ = normalize(place_.point(at.point) - origin_);
                continue;
            }
            origin_ = c.point;
            direction_ = reflect(direction_, dot(direction_, c.normal) > 0.0 ? -c.normal : c.normal);
        }
    }

    MeshRef mesh_;
    Affine place_;
    Dice dice_;
    Bvh bvh_;
    ShellSet inside_;
    dvec3 origin_{0.0}, direction_{0.0};
    Count count_;
};

struct Named {
    std::string name;
    MeshRef mesh;
};

std::vector<Named> models(int argc, char** argv) {
    std::vector<Named> all{{"ball", mesh_of(ball_soup(1.0, 5))},
                           {"torus", mesh_of(torus_soup(1.0, 0.4, 96, 48))},
                           {"prism", mesh_of(half_cube(1.0, false, 0.0, false))},
                           {"diamond", mesh_of(diamond_soup())}};
    std::vector<std::filesystem::path> files(argv + std::min(argc, 2), argv + argc);
    if (files.empty())
        for (char const* name : {"bunny.obj", "spot.obj"})
            files.push_back(std::filesystem::path(SAHL_SHARED_DATA) / "models/obj" / name);
    for (auto const& file : files)
        if (std::filesystem::exists(file))
            for (ModelMesh const& mesh : read_obj(file).meshes)
                all.push_back({file.filename().string(), mesh_of(mesh.soup)});
    return all;
}

} // namespace

int main(int argc, char** argv) {
    std::uint64_t const segments = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
    std::vector<Named> const all = models(argc, argv);
    for (Named const& model : all)
        for (bool moved : {false, true}) {
            Dice dice(7);
            Affine const place = moved ? Affine{dice.rotation(), 10.0 * dice.direction()} : Affine{};
            double const start = cpu_seconds();
            Count const count = Walker(model.mesh, place, 1).count(segments / (2 * all.size()));
            std::printf(
                "%-12s %7zu triangles %-8s %-9s %10llu segments %6llu leaks %8llu recovered %6.0f ns\n",
                model.name.c_str(), model.mesh->soup.triangles.size(),
                model.mesh->closed() ? "closed" : "OPEN", moved ? "turned" : "",
                static_cast<unsigned long long>(count.segments), static_cast<unsigned long long>(count.leaks),
                static_cast<unsigned long long>(count.recovered),
                1e9 * (cpu_seconds() - start) / static_cast<double>(count.segments));
            std::fflush(stdout);
        }
    return 0;
}

// Figures, never asserted: the CPU seconds of one thread that a health report costs on a torus of 900 000
// triangles, without normals and with, beside make_mesh on the same triangles. Median of several rounds.
#include "support/cpu_clock.h"

#include "geometry/mesh_health.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace {

using sahl::bench::cpu_seconds;
using sahl::bench::median;

sahl::TriangleSoup torus(std::uint32_t around, std::uint32_t across, bool normals) {
    sahl::TriangleSoup soup;
    soup.face_names = {"surface"};
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < across; ++j) {
            double const u = 2.0 * std::numbers::pi * i / around, v = 2.0 * std::numbers::pi * j / across;
            sahl::dvec3 const out(std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v));
            soup.positions.push_back(0.02 * sahl::dvec3(std::cos(u), std::sin(u), 0.0) + 0.008 * out);
            if (normals)
                soup.normals.push_back(out);
            std::uint32_t const next_i = (i + 1) % around * across, next_j = (j + 1) % across;
            soup.triangles.push_back({i * across + j, next_i + j, next_i + next_j});
            soup.triangles.push_back({i * across + j, next_i + next_j, i * across + next_j});
            soup.triangle_face.resize(soup.triangles.size(), 0);
        }
    return soup;
}

} // namespace

int main() {
    for (bool const normals : {false, true}) {
        sahl::TriangleSoup const soup = torus(900, 500, normals);
        std::vector<double> making, looking;
        sahl::MeshHealth health;
        for (int round = 0; round < 5; ++round) {
            double const start = cpu_seconds();
            sahl::Mesh const mesh = sahl::make_mesh(soup);
            double const middle = cpu_seconds();
            health = sahl::health_of(mesh);
            making.push_back(middle - start);
            looking.push_back(cpu_seconds() - middle);
        }
        std::printf("%llu triangles, %s: make_mesh %.3f s, health report %.3f s of CPU, median of 5\n",
                    static_cast<unsigned long long>(health.triangles),
                    normals ? "with normals" : "without normals", median(making), median(looking));
    }
    return 0;
}

// Counts, never asserted: light that is lost in curved meshes that are rough: balls with a scanner's noise,
// and OBJ or glTF files. Arguments: hits asked for a body and method, then files.
#include "support/curved.h"
#include "support/curved_walk.h"

#include "scene/read_model.h"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

using namespace sahl;
using namespace sahl::bench;

int main(int argc, char** argv) {
    std::uint64_t const wanted = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100000;
    std::vector<std::pair<std::string, std::shared_ptr<Mesh const>>> bodies;
    for (double const noise : {1e-3, 1e-2, 0.05, 0.15})
        bodies.emplace_back("ball, noise of " + std::to_string(noise) + " edges",
                            noisy_ball(5e-3, 16, noise));
    for (int i = 2; i < argc; ++i)
        for (ModelMesh& mesh : read_model(argv[i]).meshes)
            bodies.emplace_back(argv[i], std::make_shared<Mesh const>(make_mesh(std::move(mesh.soup))));
    for (auto const& [name, mesh] : bodies)
        for (PatchKind const kind : {PatchKind::quadratic, PatchKind::fitted, PatchKind::apart}) {
            CurvedTree const tree(mesh, kind);
            double const rounding =
                64.0 * 0x1p-52 * length(glm::max(glm::abs(mesh->low), glm::abs(mesh->high)));
            CurvedWalk count;
            for (std::uint64_t ray = 0; count.hits < wanted; ++ray)
                count.walk(tree, ray, 40, rounding);
            std::printf("%-32s %s: %llu hits, %llu leaks, %llu recovered, %llu crooked\n",
                        name.substr(name.find_last_of('/') + 1).c_str(),
                        kind == PatchKind::quadratic ? "quadratic"
                        : kind == PatchKind::fitted  ? "fitted   "
                                                     : "apart    ",
                        static_cast<unsigned long long>(count.hits),
                        static_cast<unsigned long long>(count.leaks),
                        static_cast<unsigned long long>(count.recovered),
                        static_cast<unsigned long long>(count.crooked));
            if (count.leaks != 0)
                std::printf("  the last from (%.17g, %.17g, %.17g) along (%.17g, %.17g, %.17g)\n",
                            count.lost_from.x, count.lost_from.y, count.lost_from.z, count.lost_along.x,
                            count.lost_along.y, count.lost_along.z);
        }
    return 0;
}

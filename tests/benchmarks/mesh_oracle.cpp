// Counts, never asserted: next hits on walks through closed meshes, the fast way against the exact one,
// vertices and edges aimed at. Arguments: hits asked for in all, then OBJ files to add to the made bodies.
#include "support/mesh_walk.h"
#include "support/meshes.h"

#include "scene/read_model.h"

#include <cstdio>
#include <cstdlib>
#include <string>

using namespace sahl;
using namespace sahl::bench;

int main(int argc, char** argv) {
    std::uint64_t const wanted = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000000;
    std::vector<std::pair<std::string, TriangleSoup>> bodies{
        {"ball", geodesic_soup(5e-3, 71)},
        {"torus", torus_soup(1.0, 0.4, 200, 100)},
        {"box", box_soup(dvec3(-1.0), dvec3(1.0))},
        {"plate of 1e-6", box_soup({-1.0, -1.0, -5e-7}, {1.0, 1.0, 5e-7})},
        {"bubble in a ball", together(ball_soup(1.0, 5), inside_out(ball_soup(0.5, 5, {0.2, 0.1, 0.0})))},
    };
    for (int i = 2; i < argc; ++i)
        for (ModelMesh& mesh : read_model(argv[i]).meshes)
            bodies.emplace_back(argv[i], std::move(mesh.soup));
    std::uint64_t asked = 0, different = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        MeshTree const tree(std::make_shared<Mesh const>(make_mesh(std::move(bodies[i].second))));
        MeshWalk walk(tree, 1000 + i);
        WalkCount count;
        while (count.asked < wanted / bodies.size())
            walk.walk(20, count);
        std::printf(
            "%-20s %8zu triangles, %s: %9llu asked, %9llu hits, %llu different, %llu contradictions\n",
            bodies[i].first.substr(bodies[i].first.find_last_of('/') + 1).c_str(),
            tree.mesh().soup.triangles.size(), tree.mesh().closed() ? "closed" : "open",
            static_cast<unsigned long long>(count.asked), static_cast<unsigned long long>(count.hits),
            static_cast<unsigned long long>(count.different),
            static_cast<unsigned long long>(count.contradictions));
        asked += count.asked;
        different += count.different;
    }
    std::printf("%llu asked, %llu different from the exact answer\n", static_cast<unsigned long long>(asked),
                static_cast<unsigned long long>(different));
    return 0;
}

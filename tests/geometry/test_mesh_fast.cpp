// The fast way to the next hit, by what Embree proposes in float, against the exact one on the same lines.
#include "geometry/mesh_tree.h"
#include "support/catch.h"
#include "support/mesh_walk.h"
#include "support/meshes.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

TriangleSoup prism_soup() {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    for (double z : {-1.0, 1.0})
        for (dvec2 const corner : {dvec2(-0.5, -0.3), dvec2(0.5, -0.3), dvec2(0.0, 0.6)})
            soup.positions.push_back({corner.x, corner.y, z});
    std::uint32_t const sides[8][3] = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                                       {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
    for (auto const& [a, b, c] : sides)
        add_triangle(soup, a, b, c);
    return soup;
}

std::vector<std::pair<std::string, TriangleSoup>> bodies() {
    TriangleSoup needle = ball_soup(1.0, 2);
    for (dvec3& p : needle.positions)
        p.x *= 1e-3;
    return {
        {"ball", geodesic_soup(5e-3, 20)},
        {"ball far from its origin", ball_soup(1.0, 3, {1e5, -2e5, 3e4})},
        {"torus", torus_soup(1.0, 0.4, 60, 30)},
        {"prism", prism_soup()},
        {"plate of 1e-6", box_soup({-1.0, -1.0, -5e-7}, {1.0, 1.0, 5e-7})},
        {"flat ball of slivers", needle},
        {"bubble in a ball", together(ball_soup(1.0, 3), inside_out(ball_soup(0.5, 3, {0.2, 0.1, 0.0})))},
        {"overlapping balls", together(ball_soup(1.0, 3), ball_soup(1.0, 3, {1.0, 0.1, 0.2}))},
    };
}

WalkCount compare(TriangleSoup soup, int walks, std::uint64_t seed) {
    MeshTree const tree(std::make_shared<Mesh const>(make_mesh(std::move(soup))));
    MeshWalk walk(tree, seed);
    WalkCount count;
    for (int i = 0; i < walks; ++i)
        walk.walk(20, count);
    return count;
}

} // namespace

TEST_CASE("the next hit that Embree proposes is the exact one", "[geometry]") {
    for (auto const& [name, soup] : bodies()) {
        WalkCount const count = compare(soup, 3000, 7);
        CAPTURE(name, count.asked, count.origin, count.direction);
        CHECK(count.hits > 3000);
        CHECK(count.different == 0);
        CHECK(count.contradictions == 0);
    }
}

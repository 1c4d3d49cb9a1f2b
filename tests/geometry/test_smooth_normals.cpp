// Normals for meshes whose files have none.
#include "geometry/smooth_normals.h"
#include "support/catch.h"
#include "support/meshes.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

/// Largest angle's sine between a corner's normal and what it should be.
template <class Expected>
double worst(Mesh const& mesh, Expected const& expected) {
    double most = 0.0;
    for (std::size_t t = 0; t < mesh.soup.triangles.size(); ++t)
        for (std::uint32_t const corner : mesh.soup.triangles[t]) {
            dvec3 const n = mesh.soup.normals[corner], e = expected(t, mesh.soup.positions[corner]);
            most = std::max(most, dot(n, e) > 0.0 ? length(cross(n, e)) : 1.0);
        }
    return most;
}

dvec3 triangle_normal(Mesh const& mesh, std::size_t t) {
    auto const& [a, b, c] = mesh.soup.triangles[t];
    auto const& p = mesh.soup.positions;
    return normalize(cross(p[b] - p[a], p[c] - p[a]));
}

} // namespace

TEST_CASE("a ball gets the ball's own normals, a box those of its sides", "[geometry]") {
    auto const plain = std::make_shared<Mesh const>(
        make_mesh(together(geodesic_soup(2.0, 6), inside_out(box_soup(dvec3(-0.5), dvec3(0.5))))));
    REQUIRE(plain->soup.normals.empty());
    auto const smooth = with_smooth_normals(plain);
    CHECK(smooth->soup.triangles.size() == plain->soup.triangles.size());
    CHECK(smooth->triangle_shell == plain->triangle_shell);
    bool same_places = true;
    for (std::size_t t = 0; t < plain->soup.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            same_places = same_places && smooth->soup.positions[smooth->soup.triangles[t][k]] ==
                                             plain->soup.positions[plain->soup.triangles[t][k]];
    CHECK(same_places);
    // Max's weights are exact on a sphere; as to which side, what is traced goes by the triangles
    CHECK(worst(*smooth, [&](std::size_t t, dvec3 const& place) {
              if (length(place) < 1.0)
                  return triangle_normal(*smooth, t) *
                         (dot(triangle_normal(*smooth, t),
                              smooth->soup.normals[smooth->soup.triangles[t][0]]) < 0.0
                              ? -1.0
                              : 1.0);
              return normalize(place);
          }) < 1e-12);
    CHECK(with_smooth_normals(smooth) == smooth);
}

// What a health report says of a file's normals: against the geometry, and by which rule they were made.
#include "geometry/mesh_health.h"
#include "support/catch.h"
#include "support/meshes.h"

#include <cmath>
#include <functional>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// A ball of triangles of very different sizes and shapes: a fine one's points, drawn towards a pole.
TriangleSoup irregular_ball() {
    TriangleSoup soup = ball_soup(1.0, 4);
    for (dvec3& p : soup.positions)
        p = normalize(p + dvec3(0.0, 0.3 * p.x * p.x, 0.6));
    return soup;
}

/// One normal a vertex: the sum over its triangles of weight(e1, e2) times the triangle's unit normal, e1 and
/// e2 the sides from the vertex.
void average(TriangleSoup& soup, std::function<double(dvec3 const&, dvec3 const&)> const& weight) {
    soup.normals.assign(soup.positions.size(), dvec3(0.0));
    for (auto const& t : soup.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            dvec3 const at = soup.positions[t[i]];
            dvec3 const e1 = soup.positions[t[(i + 1) % 3]] - at, e2 = soup.positions[t[(i + 2) % 3]] - at;
            soup.normals[t[i]] += weight(e1, e2) * normalize(cross(e1, e2));
        }
    for (dvec3& normal : soup.normals)
        normal = normalize(normal);
}

double sine(dvec3 const& a, dvec3 const& b) {
    return length(cross(a, b)) / (length(a) * length(b));
}

NormalHealth normals_of(TriangleSoup soup) {
    return health_of(make_mesh(std::move(soup))).normals;
}

} // namespace

TEST_CASE("a sphere's own normals are those by Max, to rounding, however irregular its triangles",
          "[health]") {
    TriangleSoup soup = irregular_ball();
    soup.normals = soup.positions;
    NormalHealth const normals = normals_of(soup);
    CHECK(normals.vertices == soup.positions.size());
    CHECK(normals.worst < 1e-11); // slivers of 1e-2 lose some digits of 1e-16
    CHECK(normals.kind == NormalKind::max_weighted);
    CHECK(normals.against.count == 0);
    CHECK(normals.across_creases.count == 0);
}

TEST_CASE("normals weighted by area or by angle are told, with how far they are off", "[health]") {
    struct Rule {
        NormalKind kind;
        std::function<double(dvec3 const&, dvec3 const&)> weight;
    };
    Rule const rules[] = {
        {NormalKind::area_weighted, [](dvec3 const& a, dvec3 const& b) { return length(cross(a, b)); }},
        {NormalKind::angle_weighted,
         [](dvec3 const& a, dvec3 const& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }},
        {NormalKind::plain_mean, [](dvec3 const&, dvec3 const&) { return 1.0; }},
    };
    for (Rule const& rule : rules) {
        TriangleSoup soup = irregular_ball();
        average(soup, rule.weight);
        double worst = 0.0, squares = 0.0; // from the sphere's: its points are its normals
        for (std::size_t i = 0; i < soup.normals.size(); ++i) {
            double const off = sine(soup.normals[i], soup.positions[i]);
            worst = std::max(worst, std::asin(off));
            squares += std::asin(off) * std::asin(off);
        }
        NormalHealth const normals = normals_of(soup);
        CHECK(normals.kind == rule.kind);
        CHECK(normals.worst == Approx(worst).epsilon(1e-6));
        CHECK(normals.rms ==
              Approx(std::sqrt(squares / static_cast<double>(soup.normals.size()))).epsilon(1e-6));
    }
}

TEST_CASE("normals averaged over the edges of a cube are found at its eight corners", "[health]") {
    TriangleSoup soup = box_soup(dvec3(-1.0), dvec3(1.0));
    for (dvec3 const& p : soup.positions)
        soup.normals.push_back(normalize(p));
    NormalHealth const normals = normals_of(soup);
    CHECK(normals.across_creases.count == 8);
    CHECK(normals.worst_across_crease == Approx(std::acos(1.0 / std::sqrt(3.0))));
    CHECK(normals.vertices == 0);
}

TEST_CASE("a cube whose sides have their own normals agrees with its geometry", "[health]") {
    TriangleSoup const shared = box_soup(dvec3(-1.0), dvec3(1.0));
    TriangleSoup soup;
    soup.face_names = {"surface"};
    for (auto const& t : shared.triangles) {
        auto const first = static_cast<std::uint32_t>(soup.positions.size());
        for (std::uint32_t const corner : t)
            soup.positions.push_back(shared.positions[corner]);
        soup.normals.resize(soup.positions.size(),
                            normalize(cross(soup.positions[first + 1] - soup.positions[first],
                                            soup.positions[first + 2] - soup.positions[first])));
        add_triangle(soup, first, first + 1, first + 2);
    }
    NormalHealth const normals = normals_of(soup);
    CHECK(normals.vertices == 24);
    CHECK(normals.worst < 1e-15);
    CHECK(normals.across_creases.count == 0);
}

TEST_CASE("normals that point inwards are counted, and compared by their line", "[health]") {
    TriangleSoup soup = ball_soup(1.0, 3);
    for (dvec3 const& p : soup.positions)
        soup.normals.push_back(-p);
    NormalHealth const normals = normals_of(soup);
    CHECK(normals.against.count == soup.positions.size());
    CHECK(normals.worst < 1e-12);
}

TEST_CASE("a ball with its triangles' own normals is told to be flat", "[health]") {
    TriangleSoup const shared = irregular_ball();
    TriangleSoup soup;
    soup.face_names = {"surface"};
    for (auto const& t : shared.triangles) {
        auto const first = static_cast<std::uint32_t>(soup.positions.size());
        for (std::uint32_t const corner : t)
            soup.positions.push_back(shared.positions[corner]);
        soup.normals.resize(soup.positions.size(),
                            normalize(cross(soup.positions[first + 1] - soup.positions[first],
                                            soup.positions[first + 2] - soup.positions[first])));
        add_triangle(soup, first, first + 1, first + 2);
    }
    CHECK(normals_of(soup).kind == NormalKind::flat);
}

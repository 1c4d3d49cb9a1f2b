// Outlines have the size of what they outline, and frames hold what they are about.
#include "report/content.h"
#include "report/frame.h"
#include "report/sample_run.h"
#include "support/catch.h"

#include <cmath>
#include <numbers>

using namespace sahl;
using namespace sahl::report;

namespace {

constexpr View xy{0, 1}, zy{2, 1}, zx{2, 0};
constexpr double pi = std::numbers::pi;

Bounds bounds_of(Outline const& outline) {
    Bounds bounds;
    bounds.add(outline);
    return bounds;
}

double area_of(Polyline const& loop) {
    double twice = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        dvec2 const a = loop[i], b = loop[(i + 1) % loop.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

} // namespace

TEST_CASE("a sphere is a circle of its radius from every side") {
    Affine const at = sample::turned(0.7, {1.0, 2.0, 3.0});
    for (View const& view : {xy, zy, zx}) {
        Outline const outline = outline_of(Shape(Sphere{0.01}), at, view);
        REQUIRE(outline.area.size() == 1);
        for (dvec2 const& p : outline.area[0])
            CHECK(length(p - view(at.offset)) == Approx(0.01).epsilon(1e-12));
    }
}

TEST_CASE("a stretched and sheared sphere is the ellipse of its support function") {
    Affine const at{dmat3(dvec3(3, 0, 0), dvec3(1, 1, 0), dvec3(0, 0, 2)), dvec3(0.0)};
    Outline const outline = outline_of(Shape(Sphere{0.01}), at, xy);
    Bounds const bounds = bounds_of(outline);
    CHECK(bounds.high.x == Approx(0.01 * std::sqrt(10.0))); // |(3, 1, 0)|: the first row of the map
    CHECK(bounds.high.y == Approx(0.01));
    CHECK(bounds.low.x == Approx(-bounds.high.x));
}

TEST_CASE("a quadric is drawn as it lies in its box, not as the box") {
    // x² + 4 y² + z² ≤ 1, of which the box keeps |z| ≤ 0.6
    QuadricBody const body{{1, 4, 1, 0, 0, 0, 0, 0, 0, -1}, {3, 3, 1.2}};
    auto const covered = [&](View const& view) {
        double sum = 0.0;
        for (Polyline const& loop : outline_of(Shape(body), Affine{}, view).area)
            sum += area_of(loop);
        return sum;
    };
    double const zone = 2.0 * (0.6 * 0.8 + std::asin(0.6)); // of a unit circle between ±0.6
    // front and back each cover it; the cells' chords lie up to a hundredth inside it
    CHECK(covered(xy) == Approx(2.0 * pi / 2.0).epsilon(5e-3));
    CHECK(covered(zy) == Approx(2.0 * zone / 2.0).epsilon(5e-3));
    CHECK(covered(zx) == Approx(2.0 * zone).epsilon(5e-3));
}

TEST_CASE("shapes have their extents in each view") {
    auto const size = [](Shape const& shape, View const& view) {
        return bounds_of(outline_of(shape, Affine{}, view)).size();
    };
    CHECK(size(Box{{1, 2, 3}}, xy) == dvec2(1, 2));
    CHECK(size(Box{{1, 2, 3}}, zy) == dvec2(3, 2));
    CHECK(size(Cylinder{1, 5}, zy).x == Approx(5));
    CHECK(size(Cylinder{1, 5}, zy).y == Approx(2));
    CHECK(size(Prism{pi / 3, 2, 7}, xy).x == Approx(2));
    CHECK(size(Prism{pi / 3, 2, 7}, xy).y == Approx(std::sqrt(3.0)));
    CHECK(size(Prism{pi / 3, 2, 7}, zx).x == Approx(7));
    CHECK(size(Rectangle{{2, 4}}, xy) == dvec2(2, 4));
    CHECK(size(Disk{2, 1}, xy).x == Approx(4));
    CHECK(bounds_of(outline_of(Shape(Plane{}), Affine{}, xy)).empty());
}

TEST_CASE("a lens shows its vertices and its rim in profile") {
    Bounds const biconvex = bounds_of(outline_of(Shape(Lens{0.05, -0.05, 0.006, 0.02}), Affine{}, zy));
    CHECK(biconvex.low.x == Approx(0.0).margin(1e-15));
    CHECK(biconvex.high.x == Approx(0.006));
    CHECK(biconvex.size().y == Approx(0.02));
    double const sag = 0.05 - std::sqrt(0.05 * 0.05 - 0.01 * 0.01);
    Bounds const biconcave = bounds_of(outline_of(Shape(Lens{-0.05, 0.05, 0.006, 0.02}), Affine{}, zy));
    CHECK(biconcave.low.x == Approx(-sag));
    CHECK(biconcave.high.x == Approx(0.006 + sag));
    Bounds const meniscus =
        bounds_of(outline_of(Shape(Lens{0.05, 0.0, 0.006, 0.02}), sample::turned(pi / 2, {0, 0, 0}), xy));
    CHECK(meniscus.size().x == Approx(0.006)); // its axis along x
    CHECK(meniscus.size().y == Approx(0.02));
}

TEST_CASE("a rectangle on edge is one line, and a lens along its axis has no profile") {
    Outline const edge = outline_of(Shape(Rectangle{{2, 4}}), sample::turned(0.3, {0, 0, 0}), zx);
    CHECK(edge.area.empty());
    REQUIRE(edge.lines.size() == 1);
    CHECK(length(edge.lines[0][1] - edge.lines[0][0]) == Approx(2));
    CHECK(outline_of(Shape(Lens{0.05, -0.05, 0.006, 0.02}), Affine{}, xy).area.size() == 2); // its rims
}

TEST_CASE("a plane is drawn where it is seen on edge, and only there") {
    CHECK_FALSE(outline_of(Shape(Plane{}), Affine{}, xy).endless);
    auto const edge = outline_of(Shape(Plane{}), sample::moved({0, 0, 0.5}), zy).endless;
    REQUIRE(edge);
    CHECK(edge->first.x == 0.5);
    CHECK(edge->second.x == 0.0);
    CHECK(edge->second.y != 0.0);
}

TEST_CASE("the silhouette of a mesh covers what the mesh covers") {
    Mesh const cube = sample::cube(0.5);
    for (View const& view : {xy, zy, zx}) {
        for (double const angle : {0.0, 0.4, pi / 4}) {
            CAPTURE(angle);
            Affine const at = sample::turned(angle, {3, 0, 0});
            Outline const outline = outline_of(cube, at, view);
            double covered = 0.0; // the loops wind once about it for each facet in front of another
            for (Polyline const& loop : outline.area)
                covered += area_of(loop);
            double const expected = view == zx ? 1.0 : std::cos(angle) + std::sin(angle);
            CHECK(covered == Approx(2.0 * expected)); // a front and a back
        }
    }
    CHECK(bounds_of(outline_of(cube, Affine{}, xy)).size() == dvec2(1, 1));
}

TEST_CASE("creases are drawn, flat diagonals are not") {
    Outline const outline = outline_of(sample::cube(0.5), sample::turned(0.4, {0, 0, 0}), xy);
    for (Polyline const& line : outline.lines) // edges of the cube run along y here, diagonals do not
        CHECK(std::abs(line[0].x - line[1].x) < 1e-12);
    CHECK(outline.lines.size() == 2); // two of the four upright edges; the others are silhouette

    Mesh half = sample::cube(0.5);
    half.soup.triangles.resize(2); // an open sheet, facing away: its border is its silhouette
    Outline const sheet = outline_of(half, Affine{}, xy);
    CHECK(sheet.lines.empty());
    REQUIRE(sheet.area.size() == 1);
    CHECK(area_of(sheet.area[0]) == Approx(1.0));
}

TEST_CASE("the two views are those that show most") {
    auto const views = best_views({0.1, 0.05, 0.01});
    CHECK(views[0] == xy);
    CHECK(views[1] == View{0, 2}); // turned: x is the longer
    CHECK(best_views({0.02, 0.02, 0.5})[0] == zy);
    CHECK(best_views({0.02, 0.02, 0.5})[1] == zx);
    CHECK(best_views({0.0, 0.0, 0.0})[0] == xy);
}

TEST_CASE("a frame holds its content, to one scale") {
    Bounds content;
    content.add(dvec2(-1, 2));
    content.add(dvec2(9, 3));
    Frame const frame = frame_about(xy, content, 800, wanted_height(content));
    dvec2 const a = frame.pixel({-1, 3}), b = frame.pixel({9, 2});
    CHECK(a.x > frame.left);
    CHECK(a.y > frame.top);
    CHECK(b.x < frame.left + frame.width);
    CHECK(b.y < frame.top + frame.height);
    CHECK((b.x - a.x) / 10.0 == Approx(b.y - a.y));
    Frame const empty = frame_about(xy, {}, 800, 0.5);
    CHECK(std::isfinite(empty.scale));
    CHECK(empty.scale > 0.0);
}

TEST_CASE("a ray that escapes is drawn to the border") {
    Bounds content;
    content.add(dvec2(-1, -1));
    content.add(dvec2(1, 1));
    Frame const frame = frame_about(xy, content, 800, 0.5);
    auto const right = clipped(frame, {0, 0}, {1, 0}, INFINITY);
    REQUIRE(right);
    CHECK(right->first == dvec2(0, 0));
    CHECK(right->second.x == Approx(frame.world.high.x));
    auto const finite = clipped(frame, {0, 0}, {1, 0}, 0.5);
    REQUIRE(finite);
    CHECK(finite->second == dvec2(0.5, 0));
    CHECK_FALSE(clipped(frame, {0, 100}, {1, 0}, INFINITY));
    CHECK_FALSE(clipped(frame, {0, 0}, {0, 0}, INFINITY)); // along the line of sight
    CHECK_FALSE(clipped(frame, {NAN, 0}, {1, 0}, 1.0));
}

TEST_CASE("a segment that ends far away does not make the drawing a dot") {
    sample::Run run = sample::run();
    auto const extent = [&] {
        return content_of(run.scene, run.scene.bodies.size(), sample_of(run.paths, 1000)).size.x;
    };
    double const before = extent();
    run.paths.push_back(sample::segment(36, 500, {0, 0, 0}, {1e3, 0, 0}, 1e-9));
    CHECK(extent() == before);
    run.paths.push_back(
        sample::segment(37, 500, {0.15, 0, 0}, {0.2, 0, 0}, 1e-9)); // but it holds what is near
    CHECK(extent() > before + 0.1);
    run.paths.push_back(sample::segment(38, 500, {-50, 0, 0}, {0, 0, 0}, 1e-9)); // and where rays start
    run.paths.back().parent = -1;
    CHECK(extent() > 50);
}

TEST_CASE("too many segments are thinned by whole rays") {
    std::vector<Segment> paths;
    for (std::uint64_t ray = 0; ray < 100; ++ray)
        for (int i = 0; i < 10; ++i)
            paths.push_back(sample::segment(ray, 500, {0, 0, 0}, {1, 0, 0}, 1.0));
    CHECK(sample_of(paths, 1000).rays == 100);
    Sample const thinned = sample_of(paths, 200);
    CHECK(thinned.rays == 20);
    CHECK(thinned.segments.size() == 200);
    CHECK(thinned.segments.back()->ray == 95); // spread over all
    Sample const lone = sample_of(std::vector<Segment>(paths.begin(), paths.begin() + 10), 3);
    CHECK(lone.rays == 1);
    CHECK(lone.segments.size() == 3);
    CHECK(sample_of({}, 10).rays == 0);
}

// Open meshes as surfaces: the same light as from an exact sheet, nothing slips between triangles, and a ray
// knows the side that it is on.
#include "geometry/mesh_sheet.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"
#include "support/meshes.h"

#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// z = height(x, y) over [-1, 1]², `cells` by `cells` squares, each cut in two.
template <class Height>
TriangleSoup field(std::uint32_t cells, Height const& height) {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    for (std::uint32_t j = 0; j <= cells; ++j)
        for (std::uint32_t i = 0; i <= cells; ++i) {
            double const x = 2.0 * i / cells - 1.0, y = 2.0 * j / cells - 1.0;
            soup.positions.push_back({x, y, height(x, y)});
        }
    for (std::uint32_t j = 0; j < cells; ++j)
        for (std::uint32_t i = 0; i < cells; ++i) {
            std::uint32_t const a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
            add_triangle(soup, a, b, d);
            add_triangle(soup, a, d, c);
        }
    return soup;
}

double flat(double, double) {
    return 0.0;
}

/// A scene of open meshes, each with a surface, and what else the lab has.
struct SheetSpec {
    TriangleSoup soup;
    SurfaceId surface;
    Affine place{};
};

Scene with_sheets(Lab const& lab, std::vector<SheetSpec> specs) {
    Scene scene = build_scene(lab.experiment);
    std::vector<PlacedGeometry> geometries;
    FaceId face{0};
    ShellId shell{0};
    for (Body const& body : scene.bodies) {
        geometries.push_back({*body.shape, body.to_world, face, shell, body.detector.has_value(), false});
        face.value += static_cast<std::uint32_t>(face_names(*body.shape).size());
        shell.value += body.open ? 0 : 1;
    }
    for (SheetSpec& spec : specs) {
        ObjectId const id{static_cast<std::uint32_t>(scene.bodies.size())};
        auto const mesh = std::make_shared<Mesh const>(make_mesh(std::move(spec.soup)));
        scene.bodies.push_back(
            {"mesh", true, scene.surroundings, 0, {}, mesh, Method::facet, {}, spec.place});
        scene.faces.push_back({"mesh.surface", id, spec.surface});
        geometries.push_back({mesh, spec.place, face, shell, false, false, true});
        ++face.value;
    }
    scene.bvh = std::make_unique<Bvh const>(std::move(geometries));
    return scene;
}

std::vector<Event> ends(Traced const& traced) {
    std::vector<Event> events;
    for (Segment const& segment : traced.segments())
        events.push_back(segment.ended);
    return events;
}

} // namespace

TEST_CASE("a mesh's components say whether they are open, and can be taken apart", "[geometry]") {
    TriangleSoup soup = box_soup(dvec3(2.0), dvec3(3.0));
    TriangleSoup const sheet = field(3, flat);
    std::uint32_t const first = static_cast<std::uint32_t>(soup.positions.size());
    soup.positions.insert(soup.positions.end(), sheet.positions.begin(), sheet.positions.end());
    for (auto const& [a, b, c] : sheet.triangles)
        add_triangle(soup, first + a, first + b, first + c);
    Mesh const mesh = make_mesh(soup);
    REQUIRE(mesh.shells.size() == 2);
    CHECK(mesh.shells[0].open == false);
    CHECK(mesh.shells[1].open == true);
    Mesh const box = part_of(mesh, std::vector<std::uint32_t>{0});
    CHECK(box.soup.triangles.size() == 12);
    CHECK(box.soup.positions.size() == 8);
    CHECK(box.closed());
    CHECK(box.low == dvec3(2.0));
    CHECK(box.shells[0].volume == Approx(1.0).epsilon(1e-14));
    Mesh const open = part_of(mesh, std::vector<std::uint32_t>{1});
    CHECK(open.soup.triangles.size() == 18);
    CHECK(open.high == dvec3(1.0, 1.0, 0.0));
    CHECK_FALSE(open.closed());
}

TEST_CASE("a flat mesh is met where the exact rectangle is, on edges and vertices too", "[geometry]") {
    Dice dice(1);
    for (int k = 0; k < 20; ++k) {
        Affine const place{dice.rotation(), dice.in_box(dvec3(-1.0), dvec3(1.0))};
        Lab mesh, exact;
        SurfaceId const mirror = mesh.surface(Shares{1.0, 0.0});
        exact.sheet("exact", Rectangle{{2.0, 2.0}}, exact.surface(Shares{1.0, 0.0}), place);
        std::vector<RaySpec> rays;
        for (int i = 0; i < 200; ++i) { // every other one at a vertex or at the middle of an edge
            dvec3 target = dice.in_box(dvec3(-1.0, -1.0, 0.0), dvec3(1.0, 1.0, 0.0));
            if (i % 2 == 0)
                target = dvec3(0.25 * std::round(3.4 * target.x), 0.25 * std::round(3.4 * target.y), 0.0);
            dvec3 const from = dice.in_box(dvec3(-2.0), dvec3(2.0));
            rays.push_back({place.point(from), normalize(place.vector(target - from))});
        }
        mesh.rays(rays);
        exact.rays(rays);
        Traced const a = trace(with_sheets(mesh, {{field(8, flat), mirror, place}}), {});
        Traced const b = trace(exact);
        REQUIRE(a.segments().size() == b.segments().size());
        for (std::size_t i = 0; i < a.segments().size(); ++i) {
            CHECK(a.segments()[i].ended == b.segments()[i].ended);
            CHECK(length(a.segments()[i].direction - b.segments()[i].direction) < 1e-13);
            if (std::isfinite(b.segments()[i].length))
                CHECK(std::abs(a.segments()[i].length - b.segments()[i].length) < 1e-13);
        }
    }
}

TEST_CASE("a mirror of hills is met once each time, and loses no ray through itself", "[geometry]") {
    // Above the hills every ray comes down, is reflected among them and leaves upwards: none passes through.
    Dice dice(2);
    Lab lab;
    SurfaceId const mirror = lab.surface(Shares{1.0, 0.0});
    std::vector<RaySpec> rays;
    for (int i = 0; i < 4000; ++i) {
        dvec3 const target = dice.in_box(dvec3(-0.6, -0.6, 0.0), dvec3(0.6, 0.6, 0.0));
        dvec3 const from = dice.in_box(dvec3(-0.5, -0.5, 1.0), dvec3(0.5, 0.5, 2.0));
        rays.push_back({from, normalize(target - from)});
    }
    lab.rays(rays);
    auto const hills = [](double x, double y) { return 0.03 * std::sin(9.0 * x) * std::cos(8.0 * y); };
    Traced const traced = trace(with_sheets(lab, {{field(40, hills), mirror}}), {});
    for (Segment const& segment : traced.segments())
        if (segment.ended == Event::escaped)
            CHECK(segment.direction.z > 0.0);
    CHECK(traced.ended(Event::escaped) == 4000);
    CHECK(traced.ended(Event::reflected) >= 4000);
    CHECK(traced.ended(Event::leak) == 0);
    for (Segment const& segment :
         traced.segments()) // no piece of no length: it would be the same place again
        CHECK(segment.length > 1e-6);
}

TEST_CASE("two mirrors of one open mesh at a right angle send light back where it came from", "[geometry]") {
    // z = |x|: a groove, whose sides share an edge
    Dice dice(3);
    Lab lab;
    SurfaceId const mirror = lab.surface(Shares{1.0, 0.0});
    std::vector<RaySpec> rays;
    for (int i = 0; i < 1000; ++i)
        rays.push_back({{dice.between(-0.4, 0.4), dice.between(-0.4, 0.4), 3.0},
                        normalize(dvec3(dice.between(-0.1, 0.1), 0.0, -1.0))});
    lab.rays(rays);
    Traced const traced =
        trace(with_sheets(lab, {{field(6, [](double x, double) { return std::abs(x); }), mirror}}), {});
    CHECK(traced.ended(Event::reflected) == 2000);
    for (Segment const& segment : traced.segments())
        if (segment.ended == Event::escaped)
            CHECK(length(segment.direction + rays[segment.ray].direction) < 1e-14);
}

TEST_CASE("a ray that starts on an open mesh leaves it on the side that it heads for", "[geometry]") {
    for (double side : {1.0, -1.0}) {
        Lab lab;
        SurfaceId const mirror = lab.surface(Shares{1.0, 0.0});
        lab.rays({{{0.1, 0.2, 0.0}, normalize(dvec3(0.3, 0.1, side))}});
        Traced const traced = trace(with_sheets(lab, {{field(4, flat), mirror}}), {});
        CHECK(ends(traced) == std::vector<Event>{Event::escaped});
    }
}

TEST_CASE("a half mirror that is an open mesh splits light once, and the halves go their ways",
          "[geometry]") {
    Lab lab;
    SurfaceId const half = lab.surface(Shares{0.5, 0.5});
    lab.rays({{{0.1, 0.2, 1.0}, {0.0, 0.0, -1.0}}});
    Traced const traced = trace(with_sheets(lab, {{field(4, flat), half}}), {});
    CHECK(ends(traced) == std::vector<Event>{Event::refracted, Event::escaped, Event::escaped});
    CHECK(traced.segments()[1].direction == dvec3(0.0, 0.0, -1.0));
}

TEST_CASE("an open mesh glued to a face of a body acts in the face's place", "[geometry]") {
    Lab lab;
    lab.body("block", Box{{2.0, 2.0, 2.0}}, lab.medium(1.5), moved({0.0, 0.0, -1.0}));
    SurfaceId const mirror = lab.surface(Shares{1.0, 0.0});
    lab.rays({{{0.1, 0.2, -1.5}, normalize(dvec3(0.1, 0.05, 1.0))}}); // inside, towards the mirror
    lab.experiment.trace.max_depth = 1;
    Traced const traced = trace(with_sheets(lab, {{field(4, flat), mirror}}), lab.experiment.trace);
    REQUIRE(traced.segments().size() >= 2);
    CHECK(traced.segments()[0].ended == Event::reflected);
    CHECK(traced.segments()[0].power_end == 1.0);
    CHECK(traced.segments()[1].medium == traced.segments()[0].medium);
}

// Meshes as careless programs write them, judged by the exact shape that they stand for: by no method is
// light lost or a direction no number, and where a curved surface would do worse than the triangles, `auto`
// does not take it.
#include "geometry/smooth_fans.h"
#include "geometry/tessellate.h"
#include "run/holes.h"
#include "run/method_choice.h"
#include "run/normal_warnings.h"
#include "scene/model_body.h"

#include "math/random.h"
#include "support/catch.h"
#include "support/curved.h"
#include "support/lab.h"
#include "support/lathe.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr double radius = 5e-3;

struct Judged {
    std::map<Method, PathErrors> by; // method
    std::uint64_t lost = 0;          // segments, by all methods
    MethodChoice choice;             // of auto
    PathErrors chosen;
    std::string text;
};

bool lost(Segment const& segment) {
    return segment.ended == Event::leak || segment.ended == Event::invalid ||
           !std::isfinite(segment.direction.x + segment.direction.y + segment.direction.z);
}

Lab lab_of(double beam_radius) {
    Lab lab;
    lab.experiment.trace.min_power = 1e-3;
    lab.source(slanting_beam(beam_radius, 1000));
    return lab;
}

Judged judged(Shape const& shape, std::shared_ptr<Mesh const> const& mesh, double beam_radius = 0.8 * radius,
              double tolerance = 1e-3) {
    Lab exact_lab = lab_of(beam_radius), mesh_lab = lab_of(beam_radius);
    MediumId const glass = exact_lab.medium(1.5);
    mesh_lab.medium(1.5);
    exact_lab.body("body", shape, glass);
    Scene const exact = build_scene(exact_lab.experiment);
    Scene scene = with_meshes(build_scene(mesh_lab.experiment), {{"body", mesh, glass, {}, 0}});
    WavelengthTable const optics(exact);
    Emission const emission(exact.sources, optics, 1);
    TraceOptions options = mesh_lab.experiment.trace;
    options.tolerance = tolerance;
    std::vector<std::uint64_t> const rays = spread_rays(emission, 700, 0.77);
    Trees const truth = trees_of(exact, optics, emission, options, rays);
    Judged result;
    std::ostringstream text;
    for (Method const method : {Method::facet, Method::interpolated, Method::quadratic, Method::fitted}) {
        if (method == Method::interpolated && mesh->soup.normals.empty())
            continue;
        std::vector<BodyMethod> const methods(scene.bodies.size(), body_method(method));
        scene.bvh = bvh_with(scene, methods);
        Trees const trees = trees_of(scene, optics, emission, options, rays);
        std::uint64_t lost_here = 0;
        for (auto const& tree : trees)
            lost_here += static_cast<std::uint64_t>(std::count_if(tree.begin(), tree.end(), lost));
        result.lost += lost_here;
        PathErrors const& errors = result.by[method] = compare_paths(trees, truth, false);
        text << name_of(method) << " RMS " << errors.rms << ", max " << errors.greatest << ", other events "
             << errors.changed_share() << ", lost " << lost_here << "; ";
    }
    result.choice = choose_methods(scene, optics, emission, options);
    result.chosen = compare_paths(trees_of(scene, optics, emission, options, rays), truth, false);
    text << "auto: " << name_of(scene.bodies.front().method) << ", bound "
         << result.choice.bodies.front().bound.value_or(-1.0) << ", RMS " << result.chosen.rms << ", max "
         << result.chosen.greatest;
    for (std::string const& warning : result.choice.warnings)
        text << "; " << warning;
    result.text = text.str();
    return result;
}

double rms(Judged const& judged, Method method) {
    return judged.by.at(method).rms;
}

/// Normals in steps of 1/127 or 1/32767, as KHR_mesh_quantization has them.
std::shared_ptr<Mesh const> with_coarse_normals(std::uint32_t frequency, double steps) {
    TriangleSoup soup = float_ball(radius, frequency)->soup;
    for (dvec3& n : soup.normals)
        n = normalize(glm::round(n * steps));
    return std::make_shared<Mesh const>(make_mesh(std::move(soup)));
}

/// Each triangle has corners of its own.
TriangleSoup unshared(TriangleSoup const& soup) {
    TriangleSoup apart;
    apart.face_names = soup.face_names;
    for (auto const& corners : soup.triangles) {
        auto const first = static_cast<std::uint32_t>(apart.positions.size());
        for (std::uint32_t const corner : corners) {
            apart.positions.push_back(soup.positions[corner]);
            if (!soup.normals.empty())
                apart.normals.push_back(soup.normals[corner]);
        }
        add_triangle(apart, first, first + 1, first + 2);
    }
    return apart;
}

/// Averaged over all triangles round each place, whatever lies between them.
std::shared_ptr<Mesh const> averaged(TriangleSoup soup) {
    for (dvec3& p : soup.positions)
        p = as_float(p);
    std::map<std::array<double, 3>, dvec3> sums;
    auto const key = [&](std::uint32_t i) {
        dvec3 const& p = soup.positions[i];
        return std::array<double, 3>{p.x, p.y, p.z};
    };
    for (auto const& [a, b, c] : soup.triangles)
        for (std::uint32_t const i : {a, b, c})
            sums[key(i)] +=
                cross(soup.positions[b] - soup.positions[a], soup.positions[c] - soup.positions[a]);
    soup.normals.clear();
    for (std::uint32_t i = 0; i < soup.positions.size(); ++i)
        soup.normals.push_back(normalize(as_float(normalize(sums[key(i)]))));
    return std::make_shared<Mesh const>(make_mesh(std::move(soup)));
}

/// Every place moved along the radius.
///   share   of the edge of a triangle, the standard deviation
TriangleSoup noisy_ball(std::uint32_t frequency, double share) {
    TriangleSoup soup = geodesic_soup(radius, frequency);
    std::map<std::array<double, 3>, std::uint64_t> number;
    double const edge = 1.2 / frequency;
    for (dvec3& p : soup.positions) {
        auto const q = as_float(p);
        std::uint64_t const at = number.try_emplace({q.x, q.y, q.z}, number.size()).first->second;
        double const u = uniform(9, at, 0, 0) + uniform(9, at, 0, 1) + uniform(9, at, 0, 2) - 1.5; // σ = ½
        p = q * (1.0 + 2.0 * share * edge * u);
    }
    return soup;
}

} // namespace

TEST_CASE("normals of 8 or 16 bits make no curved surface worse than the triangles", "[curved]") {
    for (std::uint32_t const frequency : {10u, 28u})
        for (double const steps : {127.0, 32767.0}) {
            Judged const ball = judged(Sphere{radius}, with_coarse_normals(frequency, steps));
            INFO(20 * frequency * frequency << " triangles, steps of 1/" << steps << ": " << ball.text);
            CHECK(ball.lost == 0);
            CHECK(rms(ball, Method::interpolated) < 0.2 * rms(ball, Method::facet));
            CHECK(rms(ball, Method::quadratic) < 3e-5); // what normals of 16 bits leave of a coarse ball
            CHECK(rms(ball, Method::fitted) < 3e-5);
            CHECK(ball.chosen.greatest <= ball.choice.bodies.front().bound.value_or(0.0));
        }
}

TEST_CASE("where normals of few digits make interpolation worse than the triangles, the summary says so",
          "[curved]") {
    Lab lab;
    MediumId const glass = lab.medium(1.5);
    auto const warned = [&](std::shared_ptr<Mesh const> const& mesh, Method method) {
        Scene scene = with_meshes(build_scene(lab.experiment), {{"body", mesh, glass, {}, 0}});
        scene.bodies.front().method = method;
        std::string all;
        for (std::string const& warning : normal_warnings(scene))
            all += warning + "\n";
        return all;
    };
    auto const coarse = with_coarse_normals(60, 15.0);
    CHECK(warned(coarse, Method::interpolated).find("worse than facet") != std::string::npos);
    CHECK(warned(coarse, Method::fitted).find("places alone") != std::string::npos);
    CHECK(warned(coarse, Method::facet).empty());
    CHECK(warned(with_coarse_normals(10, 15.0), Method::interpolated).empty()); // of few triangles it is not
    CHECK(warned(float_ball(radius, 20), Method::interpolated).empty());
    dvec3 const half(4e-3, 5e-3, 6e-3);
    CHECK(warned(averaged(box_soup(-half, half)), Method::interpolated).find("averaged over creases") !=
          std::string::npos);
}

TEST_CASE("seams that are not welded and vertices split by texture coordinates change nothing", "[curved]") {
    auto const ball = float_ball(radius, 12);
    auto const split = std::make_shared<Mesh const>(make_mesh(unshared(ball->soup)));
    Judged const one = judged(Sphere{radius}, ball), other = judged(Sphere{radius}, split);
    for (auto const& [method, errors] : one.by)
        CHECK(other.by.at(method).by_ray == errors.by_ray);
}

TEST_CASE("a seam that is open by the last bit of a float is said to be open, and is not curved",
          "[curved]") {
    TriangleSoup soup = unshared(float_ball(radius, 6)->soup);
    for (std::size_t i = 0; i < 30; ++i) // ten triangles
        soup.positions[i] *= 1.0 + 0x1p-23;
    Mesh const mesh = make_mesh(std::move(soup));
    CHECK(!mesh.closed());
    CHECK(object_method(mesh, false, Method::fitted) == Method::interpolated);
    Lab lab;
    MediumId const glass = lab.medium(1.5);
    Scene const scene = with_meshes(build_scene(lab.experiment),
                                    {{"body", std::make_shared<Mesh const>(mesh), glass, {}, 0}});
    auto const warnings = unclosed_warnings(scene);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings.front().find("not closed") != std::string::npos);
}

TEST_CASE("a cube whose normals are averaged over its edges stays a cube", "[curved]") {
    dvec3 const half(4e-3, 5e-3, 6e-3);
    Judged const cube = judged(Box{2.0 * half}, averaged(box_soup(-half, half)), 0.003);
    for (Method const method : {Method::facet, Method::quadratic, Method::fitted}) {
        CHECK(cube.by.at(method).greatest < 1e-12);
        CHECK(cube.by.at(method).changed == 0);
    }
    CHECK(cube.lost == 0);
    CHECK(cube.chosen.greatest < 1e-12);
    CHECK(cube.chosen.changed == 0);
}

TEST_CASE("normals averaged over a lens's rim spoil no curved surface within it", "[curved]") {
    TriangleSoup const soup = lens_soup(0.012, -0.012, 0.005, 0.005, 12, 72);
    Judged const lens = judged(Lens{0.012, -0.012, 0.005, 0.01}, averaged(soup), 0.0048); // to the last ring
    INFO(lens.text);
    CHECK(lens.lost == 0);
    CHECK(rms(lens, Method::quadratic) < 0.2 * rms(lens, Method::facet));
    CHECK(rms(lens, Method::fitted) < 1e-3 * rms(lens, Method::facet));
    CHECK(lens.chosen.greatest <= lens.choice.bodies.front().bound.value_or(0.0));
}

TEST_CASE("a scan's noise costs what it is in slope, by no method more than by the triangles", "[curved]") {
    for (double const share : {1e-3, 1e-2, 5e-2}) {
        Judged const ball = judged(Sphere{radius}, averaged(noisy_ball(20, share)));
        INFO("noise of " << share << " of an edge: " << ball.text);
        CHECK(ball.lost == 0);
        for (Method const method : {Method::interpolated, Method::quadratic, Method::fitted})
            CHECK(rms(ball, method) < rms(ball, Method::facet));
        CHECK(rms(ball, Method::interpolated) < 2.5 * share + 5e-3); // and what is left without noise
        CHECK(ball.chosen.greatest <= ball.choice.bodies.front().bound.value_or(0.0));
        CHECK(ball.choice.warnings.size() == 1); // that 1e-3 rad is not to be had
    }
}

TEST_CASE("of a mesh so fine that floats blur its places, the normals are believed", "[curved]") {
    auto const fine = smooth_fans(float_ball(radius, 110)); // 242 000 triangles, edges of 50 µm
    INFO(fine.normals_off << " rad off, places tell " << fine.positions_blur);
    CHECK(fine.normals == NormalUse::files);
    CHECK(smooth_fans(with_coarse_normals(110, 127.0)).normals == NormalUse::first_order);
}

TEST_CASE("normals of a mesh so fine that each is nearly its triangle's own are not taken for those",
          "[curved]") {
    TriangleSoup flat = unshared(tessellate(Lens{0.05, -0.05, 0.01, 0.006}, 600).soup); // edges of 30 µm
    auto const smooth = [](TriangleSoup soup) {
        return smooth_fans(std::make_shared<Mesh const>(make_mesh(std::move(soup)))).normals;
    };
    CHECK(smooth(flat) == NormalUse::files);
    for (std::size_t t = 0; t < flat.triangles.size(); ++t) {
        dvec3 const *const p = &flat.positions[3 * t], own = normalize(cross(p[1] - p[0], p[2] - p[0]));
        for (std::size_t k = 0; k < 3; ++k)
            flat.normals[3 * t + k] = own;
    }
    CHECK(smooth(flat) == NormalUse::flat);
}

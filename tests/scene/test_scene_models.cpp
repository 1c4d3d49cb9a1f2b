// The models that come with the program, through the whole of reading, placing and tracing: no light is lost,
// and finer meshes come nearer to the exact shape.
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"

#include <cmath>
#include <map>

using namespace sahl;
using namespace sahl::bench;

namespace {

std::filesystem::path model(std::string const& name) {
    return std::filesystem::path(SAHL_SOURCE_DIR) / "models" / name;
}

/// The model, of glass of index 1.5.
void put_model(Lab& lab, std::string const& file, Affine const& place = {}) {
    ModelReference reference;
    reference.path = model(file);
    lab.experiment.objects.push_back({file, reference, place, lab.medium(1.5), {}, {}, 0, {}});
}

std::vector<RaySpec> rays_at(Dice& dice, double reach, int count, Affine const& place) {
    std::vector<RaySpec> rays;
    for (int k = 0; k < count; ++k) {
        dvec3 const direction = dice.direction(), at = dice.in_box(dvec3(-reach), dvec3(reach));
        rays.push_back({place.point(at - 0.1 * direction), normalize(place.vector(direction))});
    }
    return rays;
}

char const* const files[] = {"ball-320.glb",    "ball-1280.glb",    "ball-5120.glb",     "ball-20480.glb",
                             "singlet-504.glb", "singlet-4104.glb", "singlet-15984.glb", "prism.gltf"};

/// RMS angle between the directions in which rays leave two scenes that should be the same, over rays that
/// meet the same number of surfaces.
double direction_error(Traced const& one, Traced const& other) {
    auto const straight = [](Traced const& traced) { // the last of each ray's twice refracted path
        std::map<std::uint64_t, dvec3> exits;
        for (Segment const& s : traced.segments())
            if (s.depth == 2 && s.born == Event::refracted && s.ended == Event::escaped)
                exits[s.ray] = s.direction;
        return exits;
    };
    auto const a = straight(one), b = straight(other);
    double sum = 0.0;
    std::size_t count = 0;
    for (auto const& [ray, direction] : a)
        if (auto const found = b.find(ray); found != b.end()) {
            sum += dot(direction - found->second, direction - found->second);
            ++count;
        }
    REQUIRE(count > 100);
    return std::sqrt(sum / static_cast<double>(count));
}

} // namespace

TEST_CASE("every model that comes with the program is traced without a leak, wherever it stands") {
    Dice dice(1);
    for (char const* file : files)
        for (int k = 0; k < 2; ++k) {
            Affine const place = k ? Affine{dice.rotation(), dice.direction()} : Affine{};
            Lab lab;
            put_model(lab, file, place);
            lab.rays(rays_at(dice, 0.012, 2000, place));
            lab.experiment.trace.min_power = 1e-3;
            Traced const traced = trace(lab, 0);
            CAPTURE(file, k);
            CHECK(traced.scene.warnings.empty());
            CHECK(traced.ended(Event::leak) + traced.ended(Event::invalid) == 0);
            CHECK(traced.ended(Event::refracted) > 1000);
            CHECK(std::abs(traced.result.tally.remainder()) < 1e-13);
        }
}

TEST_CASE("rays aimed at every vertex of a model leak nowhere, within it neither") {
    for (std::string const file : {"ball-1280.glb", "singlet-504.glb", "prism.gltf"}) {
        Lab lab;
        put_model(lab, file);
        lab.experiment.trace.min_power = 1e-4;
        std::shared_ptr<Mesh const> const mesh = build_scene(lab.experiment).bodies.front().mesh;
        std::vector<RaySpec> rays;
        dvec3 const middle = 0.5 * (mesh->low + mesh->high);
        dvec3 const aside = middle + 0.1 * (mesh->high - mesh->low) * dvec3(0.3, 0.5, -0.2);
        for (dvec3 const& vertex : mesh->soup.positions) {
            rays.push_back({aside, normalize(vertex - aside)});
            rays.push_back({middle, normalize(vertex - middle)});                // from within
            rays.push_back({2.0 * vertex - middle, normalize(middle - vertex)}); // along a diameter
            rays.push_back({vertex - dvec3(0.0, 0.0, 0.1), {0.0, 0.0, 1.0}});    // as a beam on a grid
        }
        for (auto const& [a, b, c] : mesh->soup.triangles) // at the middles of edges
            rays.push_back(
                {middle, normalize(0.5 * (mesh->soup.positions[a] + mesh->soup.positions[b]) - middle)});
        lab.rays(rays);
        Traced const traced = trace(lab, 0);
        CAPTURE(file);
        CHECK(traced.ended(Event::leak) + traced.ended(Event::invalid) == 0);
        CHECK(std::abs(traced.result.tally.remainder()) < 1e-13);
    }
}

TEST_CASE("finer meshes trace more like the exact shape: first order by facets, second by their normals") {
    Dice dice(2);
    std::vector<RaySpec> rays;
    for (int k = 0; k < 2000; ++k) // not near the rim, where a facet more or less changes everything
        rays.push_back(
            {{0.003 * dice.between(-1.0, 1.0), 0.003 * dice.between(-1.0, 1.0), -0.05}, {0.0, 0.0, 1.0}});
    Lab exact;
    exact.body("ball", Sphere{0.005}, exact.medium(1.5));
    exact.rays(rays);
    exact.experiment.trace.min_power = 0.1;
    Traced const truth = trace(exact);
    for (Method method : {Method::facet, Method::interpolated}) {
        std::vector<double> errors;
        for (char const* file : {"ball-320.glb", "ball-1280.glb", "ball-5120.glb", "ball-20480.glb"}) {
            Lab lab;
            lab.experiment.trace.method = method;
            lab.experiment.trace.min_power = 0.1;
            put_model(lab, file);
            lab.rays(rays);
            errors.push_back(direction_error(truth, trace(lab)));
        }
        double const ratio = method == Method::facet ? 2.0 : 4.0; // edges of half the length
        CAPTURE(ratio, errors[0], errors[1], errors[2], errors[3]);
        CHECK(errors[0] / errors[1] == Approx(ratio).epsilon(0.2));
        CHECK(errors[1] / errors[2] == Approx(ratio).epsilon(0.2));
        CHECK(errors[2] / errors[3] == Approx(ratio).epsilon(0.2));
    }
}

TEST_CASE("a prism's flat faces are exact as a mesh too") {
    Lab exact, mesh;
    Dice dice(3);
    exact.body("prism", Prism{std::acos(0.5), 0.025, 0.025}, exact.medium(1.5));
    put_model(mesh, "prism.gltf");
    std::vector<RaySpec> const rays = rays_at(dice, 0.01, 2000, {});
    exact.rays(rays);
    mesh.rays(rays);
    // the file's corners are floats: 6e-8 of a direction, more where light leaves near the critical angle
    CHECK(direction_error(trace(exact), trace(mesh)) < 1e-6);
}

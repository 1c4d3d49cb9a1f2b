// In: media, surfaces, shapes and rays, put together in a few lines. Out: the experiment that they make,
// traced.
#pragma once

#include "scene/scene.h"
#include "trace/tracer.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sahl::bench {

struct Lab {
    Experiment experiment;

    explicit Lab(double n_surroundings = 1.0) { experiment.surroundings = medium(n_surroundings); }

    /// absorption   1/m
    MediumId medium(double n, double absorption = 0.0) {
        Medium made{"medium " + std::to_string(experiment.media.size()), ConstantIndex{n}, {}, {}};
        if (absorption > 0.0)
            made.absorption = {{500e-9, absorption}};
        experiment.media.push_back(made);
        return {static_cast<std::uint32_t>(experiment.media.size() - 1)};
    }
    template <class Kind>
    SurfaceId surface(Kind kind) {
        experiment.surfaces.push_back({"surface " + std::to_string(experiment.surfaces.size()), kind});
        return {static_cast<std::uint32_t>(experiment.surfaces.size() - 1)};
    }
    ObjectSpec& body(std::string name, Shape const& shape, MediumId of, Affine const& place = {},
                     int priority = 0) {
        return experiment.objects.emplace_back(
            ObjectSpec{std::move(name), shape, place, of, {}, {}, priority, {}});
    }
    ObjectSpec& sheet(std::string name, Shape const& shape, SurfaceId of, Affine const& place = {}) {
        return experiment.objects.emplace_back(ObjectSpec{std::move(name), shape, place, {}, of, {}, 0, {}});
    }
    DetectorSpec& detector(std::string name, Affine const& place, dvec2 size, bool absorbs = true) {
        return experiment.detectors.emplace_back(
            DetectorSpec{std::move(name), place, size, 1, 1, absorbs, false, {}});
    }
    /// A source of rays of a watt together, at 587.6 nm unless said otherwise.
    SourceSpec& rays(std::vector<RaySpec> rays) { return source(ExplicitRays{std::move(rays)}); }
    template <class Emitter>
    SourceSpec& source(Emitter emitter) {
        return experiment.sources.emplace_back(
            SourceSpec{"source " + std::to_string(experiment.sources.size()),
                       std::move(emitter),
                       {{587.6e-9, 1.0}},
                       1.0,
                       {},
                       {}});
    }
};

inline Affine moved(dvec3 const& offset) {
    return {dmat3(1.0), offset};
}

/// About the z axis, all but: along no axis, and through no centre.
inline Beam slanting_beam(double radius, std::uint64_t rays) {
    Beam beam{};
    beam.toward = normalize(dvec3(0.05, 0.02, 1.0));
    beam.from = dvec3(1e-4, 2e-4, 0.0) - 0.02 * beam.toward;
    beam.up = perpendicular_to(beam.toward);
    beam.radius = radius;
    beam.pattern = Pattern::hexagonal;
    beam.rays = rays;
    return beam;
}

/// Of a sheet or a detector at `at` whose +z looks along `facing`.
inline Affine facing(dvec3 const& at, dvec3 const& facing_, dvec3 const& up = dvec3(0.0)) {
    dvec3 const z = normalize(facing_), y = perpendicular_to(z, up);
    return {dmat3(cross(y, z), y, z), at};
}

/// A body that is a mesh, as a model's would be; the scene's faces and shells that were there keep their
/// numbers.
struct MeshSpec {
    std::string name;
    std::shared_ptr<Mesh const> mesh;
    MediumId medium;
    Affine place{};
    int priority = 0;
};

inline Scene with_meshes(Scene scene, std::vector<MeshSpec> const& specs) {
    std::vector<PlacedGeometry> geometries;
    FaceId face{0};
    ShellId shell{0};
    auto const put = [&](std::variant<Shape, std::shared_ptr<Mesh const>> geometry, Body const& body,
                         std::size_t faces, std::size_t shells) {
        geometries.push_back(
            {std::move(geometry), body.to_world, face, shell, body.detector.has_value(), false});
        face.value += static_cast<std::uint32_t>(faces);
        shell.value += static_cast<std::uint32_t>(shells);
    };
    for (Body const& body : scene.bodies)
        put(*body.shape, body, face_names(*body.shape).size(), body.open ? 0 : 1);
    for (MeshSpec const& spec : specs) {
        ObjectId const id{static_cast<std::uint32_t>(scene.bodies.size())};
        scene.bodies.push_back(
            {spec.name, false, spec.medium, spec.priority, {}, spec.mesh, Method::facet, {}, spec.place});
        for (std::string const& name : spec.mesh->soup.face_names)
            scene.faces.push_back({spec.name + "." + name, id, {}});
        for (MeshShell const& one : spec.mesh->shells)
            scene.shells.push_back({id, one.sign, spec.mesh->shells.size() == 1});
        put(spec.mesh, scene.bodies.back(), spec.mesh->soup.face_names.size(), spec.mesh->shells.size());
    }
    scene.bvh = std::make_unique<Bvh const>(std::move(geometries));
    return scene;
}

/// A scene with what traced it; every ray in one batch.
struct Traced {
    Scene scene;
    WavelengthTable optics;
    Emission emission;
    BatchResult result;

    std::vector<Segment> const& segments() const { return result.log.segments; }
    std::uint64_t ended(Event event) const { return result.tally.ended[static_cast<std::size_t>(event)]; }
    double watts(ExactSum const& sum) const { return sum.value(result.tally.unit); }
    FaceId face(std::string_view name) const {
        for (std::uint32_t i = 0; i < scene.faces.size(); ++i)
            if (scene.faces[i].name == name)
                return {i};
        return {0xFFFFFFFFu};
    }
};

inline Traced trace(Scene scene, TraceOptions const& options, std::uint64_t log_every = 1) {
    WavelengthTable optics(scene);
    Emission emission(scene.sources, optics, options.seed);
    SumUnit const unit = SumUnit::for_total(emission.power());
    BatchResult result = trace_batch({scene, optics, emission, options, unit, log_every}, 0, emission.rays());
    return {std::move(scene), std::move(optics), std::move(emission), std::move(result)};
}

inline Traced trace(Lab const& lab, std::uint64_t log_every = 1) {
    return trace(build_scene(lab.experiment), lab.experiment.trace, log_every);
}

} // namespace sahl::bench

#include "scene/scene.h"

#include "scene/closeness.h"
#include "scene/model_body.h"
#include "scene/model_cache.h"
#include "scene/model_parts.h"
#include "scene/model_picture.h"
#include "scene/read_table.h"
#include "scene/scene_methods.h"

#include "math/input_error.h"

#include <algorithm>

namespace sahl {

namespace {

/// The scene while it grows, with the geometries that will make its BVH.
struct Builder {
    Scene scene;
    std::vector<PlacedGeometry> geometries;
    ModelCache& models;

    FaceId next_face() const { return {static_cast<std::uint32_t>(scene.faces.size())}; }
    ShellId next_shell() const { return {static_cast<std::uint32_t>(scene.shells.size())}; }
    ObjectId next_body() const { return {static_cast<std::uint32_t>(scene.bodies.size())}; }

    void add_shape(ObjectSpec const& object, Shape const& shape);
    void add_model(ObjectSpec const& object, ModelReference const& reference);
    void add_part(ObjectSpec const& object, ModelPart const& part, Affine const& to_world,
                  std::string const& name);
    void add_detector(DetectorSpec const& detector, DetectorId id);
    FaceId face_called(std::string const& name, Place const& place) const;
};

std::optional<SurfaceId> surface_of(ObjectSpec const& object, std::string_view face) {
    for (auto const& [name, surface] : object.faces)
        if (name == face)
            return surface;
    return object.surface;
}

void Builder::add_shape(ObjectSpec const& object, Shape const& shape) {
    ObjectId const body = next_body();
    bool const open = is_open(shape);
    geometries.push_back({shape, object.to_world, next_face(), next_shell(), false, false});
    scene.bodies.push_back({object.name,
                            open,
                            object.medium.value_or(scene.surroundings),
                            object.priority,
                            {},
                            nullptr,
                            Method::automatic,
                            shape,
                            object.to_world});
    auto const names = face_names(shape);
    for (std::string_view name : names)
        scene.faces.push_back({names.size() == 1 ? object.name : object.name + "." + std::string(name), body,
                               surface_of(object, name)});
    if (!open)
        scene.shells.push_back({body, 1, true});
}

void Builder::add_detector(DetectorSpec const& detector, DetectorId id) {
    if (detector.kind == DetectorKind::sphere) {
        scene.sphere_detectors.push_back(id);
        return;
    }
    if (detector.kind == DetectorKind::surface) {
        scene.surface_detectors.emplace_back(face_called(detector.surface, detector.place), id);
        return;
    }
    ObjectId const body = next_body();
    geometries.push_back(
        {Shape(Rectangle{detector.size}), detector.to_world, next_face(), next_shell(), true, false});
    scene.bodies.push_back({detector.name, true, scene.surroundings, 0, id, nullptr, Method::automatic,
                            Rectangle{detector.size}, detector.to_world});
    scene.faces.push_back({detector.name, body, {}});
}

/// A face by its name as it stands in the log, or that of an object with only one.
FaceId Builder::face_called(std::string const& name, Place const& place) const {
    std::vector<std::string> names;
    for (std::uint32_t face = 0; face < scene.faces.size(); ++face) {
        if (scene.faces[face].name == name)
            return {face};
        names.push_back(scene.faces[face].name);
    }
    throw InputError(place.text(), "there is no surface \"" + name + "\"",
                     names.empty()        ? "there is no object in this experiment"
                     : names.size() <= 12 ? "give one of " + listed(names)
                                          : did_you_mean(name, names));
}

void Builder::add_model(ObjectSpec const& object, ModelReference const& reference) {
    std::shared_ptr<Model const> const read = models.model(reference.path);
    Model const& model = *read;
    scene.models.push_back(reference.path.string());
    for (std::string const& warning : model.warnings)
        scene.warnings.push_back(object.name + ": " + warning);
    auto const instances = wanted_instances(reference, model);
    check_mapping(reference, model);

    MaterialBook materials(scene, object.name, reference.metres_per_unit);
    UniqueNames names;
    std::vector<std::vector<ModelPart>> parts(model.meshes.size()); // instances share them
    Affine const unit{dmat3(reference.metres_per_unit), dvec3(0.0)};
    for (ModelInstance const* instance : instances) {
        auto& of_mesh = parts[instance->mesh];
        if (of_mesh.empty())
            of_mesh = parts_of(object, reference, models, read, instance->mesh, materials);
        if (of_mesh.empty())
            materials.warn("mesh " + model.meshes[instance->mesh].name + " has no triangles");
        Affine const to_world = compose(object.to_world, compose(unit, instance->to_world));
        for (ModelPart const& part : of_mesh)
            add_part(
                object, part, to_world,
                names.make(object.name,
                           (instances.size() == 1 ? "" : instance->name) +
                               (of_mesh.size() == 1 ? "" : (instances.size() == 1 ? "" : "_") + part.label)));
    }
    for (ModelCamera const& camera : model.cameras)
        scene.cameras.push_back(camera_of(camera, compose(object.to_world, unit)));
    for (ModelLight const& light : model.lights)
        scene.lights.push_back(light_of(light, compose(object.to_world, unit)));
    for (ModelMaterial const& material : model.materials)
        for (std::string const& warning : material.warnings)
            materials.warn(warning);
}

void Builder::add_part(ObjectSpec const& object, ModelPart const& part, Affine const& to_world,
                       std::string const& name) {
    Mesh const& mesh = *part.mesh;
    ObjectId const body = next_body();
    Method const method = object_method(mesh, part.open, scene.mesh_method);
    BodyMethod const by = body_method(method);
    geometries.push_back({part.mesh, to_world, next_face(), next_shell(), false,
                          by.interpolate || (part.open && by.curving != Curving::none), part.open,
                          by.curving});
    scene.bodies.push_back({name,
                            part.open,
                            part.medium.value_or(scene.surroundings),
                            object.priority,
                            {},
                            part.mesh,
                            method,
                            {},
                            to_world,
                            std::get<ModelReference>(object.what).decimate});
    for (std::size_t face = 0; face < mesh.soup.face_names.size(); ++face)
        scene.faces.push_back({name + "." + mesh.soup.face_names[face], body, part.surfaces[face]});
    for (std::size_t shell = 0; !part.open && shell < mesh.shells.size(); ++shell)
        scene.shells.push_back({body, mesh.shells[shell].sign, mesh.shells.size() == 1});
}

/// The pictures that the experiment itself names.
void name_textures(Scene& scene) {
    for (Surface& surface : scene.surfaces)
        if (auto const* const paint = std::get_if<Paint>(&surface.kind); paint && !paint->texture.empty()) {
            surface.texture = TextureId{static_cast<std::uint32_t>(scene.textures.size())};
            scene.textures.push_back({paint->texture, {}, paint->texture});
        }
}

} // namespace

Scene build_scene(Experiment const& experiment, ModelCache* cache) {
    ModelCache own;
    Builder builder{{}, {}, cache ? *cache : own};
    Scene& scene = builder.scene;
    scene.media = experiment.media;
    scene.surfaces = experiment.surfaces;
    name_textures(scene);
    scene.surroundings = experiment.surroundings;
    scene.sources = experiment.sources;
    scene.detectors = experiment.detectors;
    scene.warnings = experiment.warnings;
    scene.mesh_method = experiment.trace.method;
    for (ObjectSpec const& object : experiment.objects)
        if (auto const* const model = std::get_if<ModelReference>(&object.what))
            builder.add_model(object, *model);
        else
            builder.add_shape(object, std::get<Shape>(object.what));
    for (std::uint32_t i = 0; i < experiment.detectors.size(); ++i)
        builder.add_detector(experiment.detectors[i], {i});
    scene.meshes = builder.models.store();
    scene.bvh = std::make_unique<Bvh const>(std::move(builder.geometries), scene.meshes.get());
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        Body& body = scene.bodies[i];
        if (!body.mesh || curving_of(body.method) == Curving::none)
            continue;
        Curving const met = scene.bvh->curving(i);
        if (met == Curving::none) // open, and it touches something
            body.method = object_method(*body.mesh, body.open, Method::automatic);
        else if (met == Curving::fitted)
            body.method = Method::fitted;
    }
    for (std::string& warning : overlap_warnings(scene))
        scene.warnings.push_back(std::move(warning));
    return std::move(builder.scene);
}

std::span<Face const> faces_of(Scene const& scene, ObjectId body) {
    auto const before = [](Face const& face, ObjectId of) { return face.body.value < of.value; };
    auto const first = std::lower_bound(scene.faces.begin(), scene.faces.end(), body, before);
    auto const last = std::lower_bound(first, scene.faces.end(), ObjectId{body.value + 1}, before);
    return {first, last};
}

} // namespace sahl

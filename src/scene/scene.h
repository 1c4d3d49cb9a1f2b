// In: an experiment with its models read. Out: the scene as it is traced: shapes in the BVH, and by id what
// they are made of. Where shape meets substance is interface.h.
#pragma once

#include "geometry/bvh.h"
#include "image/texture.h"
#include "scene/experiment.h"
#include "scene/picture.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sahl {

/// One geometry of the BVH: an object of the experiment, an instance of a model's node, or a detector.
/// Of a mesh that is traced in fewer triangles than its file has.
struct Decimation {
    std::shared_ptr<Mesh const> whole; // as in the file
    double within = 0.0;               // m, world: no vertex left out lies farther off the triangles left
    double turn = 0.0;                 // rad: how far that moves directions, by pilots
    double sequence_changed = 0.0;     // share of the pilots that meet other events then
};

struct Body {
    std::string name; // "prism", "bunny", "bunny.body" where a model has several
    bool open = false;
    MediumId medium; // of a closed body
    int priority = 0;
    std::optional<DetectorId> detector;
    std::shared_ptr<Mesh const> mesh;  // of a model
    Method method = Method::automatic; // automatic: exact
    std::optional<Shape> shape{};      // where it is exact; neither shape nor mesh: unknown
    Affine to_world{};                 // of shape or mesh
    double decimate = 0.0;             // m, asked for by name
    std::optional<Decimation> decimated{};
};

struct Shell {
    ObjectId body;
    int sign = 1;     // +1: the body is inside; −1: a cavity of it
    bool only = true; // the body has no other shell
};

struct Face {
    std::string name; // "lens.front"
    ObjectId body;
    std::optional<SurfaceId> surface; // none: a clean boundary between two media
};

/// A picture that surfaces take their colour from: not opened before a picture of the scene is made.
struct TextureSource {
    std::filesystem::path file{};
    std::shared_ptr<std::vector<unsigned char> const> bytes{}; // of a picture within a model's file
    std::string place{}, problem{};                            // where it is named; why there is none, if so
    Wrap across = Wrap::repeat, up = Wrap::repeat;
    bool of_model = false; // the experiment's own must be there
};

struct Scene {
    std::vector<Medium> media;
    std::vector<Surface> surfaces;
    MediumId surroundings;
    std::vector<Body> bodies;  // by ObjectId, and by the BVH's object
    std::vector<Shell> shells; // by ShellId
    std::vector<Face> faces;   // by FaceId
    std::vector<SourceSpec> sources;
    std::vector<DetectorSpec> detectors;
    std::vector<std::string> models; // files, as the experiment names them
    std::vector<std::string> warnings;
    Method mesh_method = Method::automatic;                         // what the experiment asks for
    std::vector<Camera> cameras{};                                  // of models, for pictures that name none
    std::vector<Light> lights{};                                    // the same
    std::vector<TextureSource> textures{};                          // by TextureId
    std::vector<DetectorId> sphere_detectors{};                     // they count what escapes
    std::vector<std::pair<FaceId, DetectorId>> surface_detectors{}; // they count what arrives at a face
    std::unique_ptr<Bvh const> bvh{};
    std::shared_ptr<MeshStore> meshes{}; // what is made of meshes, for this and other scenes; may be absent
};

class ModelCache;

/// Reads the experiment's models and puts everything in its place. Throws InputError.
///   cache   where models come from that were read before, and where they stay; none: they are this scene's
Scene build_scene(Experiment const& experiment, ModelCache* cache = nullptr);

/// The faces of a body, which stand together.
std::span<Face const> faces_of(Scene const& scene, ObjectId body);

/// The body that fills a place: of those that the shells belong to, the one of highest priority, of equals
/// the later.
std::optional<ObjectId> body_at(Scene const& scene, ShellSet const& inside);

/// What fills a place: the body's medium, or the surroundings.
inline MediumId medium_of(Scene const& scene, std::optional<ObjectId> body) {
    return body ? scene.bodies[body->value].medium : scene.surroundings;
}

} // namespace sahl

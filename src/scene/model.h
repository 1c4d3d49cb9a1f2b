// In: nothing. Out: what a model file holds, as plain data, whatever its format: meshes in their
// own frames, materials, and instances that say where each mesh stands.
#pragma once

#include "geometry/mesh.h"
#include "image/texture.h"
#include "math/vec.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sahl {

/// What lies inside a closed boundary (KHR_materials_volume). T = attenuation_color^(x /
/// attenuation_distance), x the path in world space: a node's scale changes x, not the distance.
struct ModelVolume {
    double thickness_factor = 0.0; // 0: a thin wall; otherwise a body, whose thickness is that of its mesh
    double attenuation_distance = std::numeric_limits<double>::infinity(); // m, > 0
    std::array<double, 3> attenuation_color{1.0, 1.0, 1.0};                // [0, 1], linear RGB
};

/// A picture that a material's colour is taken from. Where it is a file, that lies in the model's folder,
/// links followed, and was not opened.
struct ModelTexture {
    std::filesystem::path file{};
    std::shared_ptr<std::vector<unsigned char> const> bytes{}; // of a picture within the model's file
    std::string place{};                                       // what a message about it starts with
    std::string problem{}; // why there is no picture; empty: there is one, as far as can be seen from outside
    Wrap across = Wrap::repeat, up = Wrap::repeat;
    std::uint32_t coordinates = 0; // which of a glTF file's sets of texture coordinates
    // what the file's coordinates go through, in its own sense of up, before they are kept: uv ↦ linear · uv
    // + offset
    std::array<dvec2, 2> linear{dvec2(1.0, 0.0), dvec2(0.0, 1.0)}; // columns
    dvec2 offset{0.0};
};

enum class AlphaMode { opaque, mask, blend };

struct ModelMaterial {
    std::string name;
    std::array<double, 4> base_color{1.0, 1.0, 1.0, 1.0}; // [0, 1], linear RGB, and coverage
    double metallic = 1.0;                                // [0, 1]
    double roughness = 1.0;                               // [0, 1]
    double transmission = 0.0;                            // [0, 1]
    double ior = 1.5;                                     // ≥ 1; or 0: reflects all
    double dispersion = 0.0;                              // 20 / V_d; 0: none
    double specular = 1.0;                                // [0, 1], of the reflection where ior is 0
    std::array<double, 3> specular_color{1.0, 1.0, 1.0};  // ≥ 0, the same
    std::optional<ModelVolume> volume;                    // absent: no KHR_materials_volume
    bool may_be_body = false; // without volume: the format has no word for it, and a closed mesh is a body
    std::optional<ModelTexture>
        color_texture; // for pictures, times base_color; tracing takes base_color alone
    AlphaMode alpha_mode = AlphaMode::opaque;
    double alpha_cutoff = 0.5; // with mask: what covers less is not there
    bool double_sided = false;
    std::vector<std::string> warnings; // what of it is not modelled
    std::string extras;                // JSON, for what the format has no word for
};

/// Each primitive (or group) is a face of `soup`, named after its material, "surface" where it has none.
struct ModelMesh {
    std::string name;
    TriangleSoup soup;                                       // in the mesh's own frame, metres
    std::vector<std::optional<std::uint32_t>> face_material; // by face; index into Model::materials
};

/// What the file's tree says of an instance beside its place.
struct ModelNode {
    std::vector<std::string> groups; // names under which it can be asked for too: of what holds it
    std::string extras;              // JSON
};

/// A mesh put in its place; several may share one mesh. `to_world` may mirror (negative determinant): the
/// winding is left as it is in the mesh, and whoever traces the instance flips the side. It is never
/// singular.
struct ModelInstance {
    std::string name;
    Affine to_world;
    std::uint32_t mesh = 0;                  // index into Model::meshes
    std::shared_ptr<ModelNode const> node{}; // shared by the copies that one node places; may be absent
};

/// Kept for pictures: tracing does not use it. It looks along −z of its frame, y is up.
struct ModelCamera {
    std::string name;
    Affine to_world;
    bool perspective = true;
    double yfov = 0.0;                   // rad, (0, π), of a perspective one
    double aspect = 0.0;                 // width / height; 0: that of the picture
    double xmag = 0.0, ymag = 0.0;       // half of the width and height seen, otherwise
    double znear = 0.0, zfar = INFINITY; // m
};

/// Kept for pictures (KHR_lights_punctual). It shines along −z of its frame.
struct ModelLight {
    enum class Kind { directional, point, spot };
    std::string name;
    Affine to_world;
    Kind kind = Kind::point;
    std::array<double, 3> color{1.0, 1.0, 1.0}; // linear RGB, [0, 1]
    double intensity = 1.0;                     // cd; lx of a directional one
    double range = INFINITY;                    // m
    double inner_cone = 0.0, outer_cone = 0.0;  // rad, of a spot
};

struct Model {
    std::vector<ModelMesh> meshes;
    std::vector<ModelMaterial> materials;
    std::vector<ModelInstance> instances; // in the order of the file's tree of nodes
    std::vector<ModelCamera> cameras{};
    std::vector<ModelLight> lights{};
    std::vector<std::string> warnings; // what a user should know: what was left out, and why
    std::string extras{};              // JSON, of the file as a whole
    bool in_metres = true;             // false: the file does not say what its lengths are in
};

} // namespace sahl

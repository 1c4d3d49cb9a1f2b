// In: nothing. Out: what a model file holds, as plain data, whatever its format: meshes in their
// own frames, materials, and instances that say where each mesh stands.
#pragma once

#include "geometry/mesh.h"
#include "math/vec.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
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

enum class AlphaMode { opaque, mask, blend };

struct ModelMaterial {
    std::string name;
    std::array<double, 4> base_color{1.0, 1.0, 1.0, 1.0}; // [0, 1], linear RGB, and coverage
    double metallic = 1.0;                                // [0, 1]
    double roughness = 1.0;                               // [0, 1]
    double transmission = 0.0;                            // [0, 1]
    double ior = 1.5;                                     // ≥ 1; or 0: reflects all
    double dispersion = 0.0;                              // 20 / V_d; 0: none
    std::optional<ModelVolume> volume;                    // absent: no KHR_materials_volume
    AlphaMode alpha_mode = AlphaMode::opaque;
    bool double_sided = false;
    std::vector<std::string> warnings; // what of it is not modelled
};

/// Each primitive (or group) is a face of `soup`, named after its material, "surface" where it has none.
struct ModelMesh {
    std::string name;
    TriangleSoup soup;                                       // in the mesh's own frame, metres
    std::vector<std::optional<std::uint32_t>> face_material; // by face; index into Model::materials
};

/// A mesh put in its place; several may share one mesh. `to_world` may mirror (negative determinant): the
/// winding is left as it is in the mesh, and whoever traces the instance flips the side. It is never
/// singular.
struct ModelInstance {
    std::string name;
    Affine to_world;
    std::uint32_t mesh = 0; // index into Model::meshes
};

struct Model {
    std::vector<ModelMesh> meshes;
    std::vector<ModelMaterial> materials;
    std::vector<ModelInstance> instances; // in the order of the file's tree of nodes
    std::vector<std::string> warnings;    // what a user should know: what was left out, and why
    bool in_metres = true;                // false: the file does not say what its lengths are in
};

} // namespace sahl

// In: a path. Out: a Model; the steps are in read_gltf_*.cpp.
#include "scene/read_gltf.h"

#include "scene/read_gltf_parts.h"

#include <tiny_gltf.h>

namespace sahl {

Model read_gltf(std::filesystem::path const& path) {
    GltfFile const file = read_gltf_file(path);
    Model model;
    Value const tree = checked_gltf_tree(file, model.warnings);
    tinygltf::Model const parsed = load_gltf(file, tree);

    model.materials = gltf_materials(file, tree, parsed);
    model.meshes = gltf_meshes(parsed, model.materials, file.name(), model.warnings);
    GltfScene scene = gltf_scene(parsed, tree, model.warnings);
    model.instances = std::move(scene.instances);
    add_cameras_and_lights(tree, scene.others, model);
    model.extras = gltf::extras_of(tree);
    GltfTextures(file, tree, parsed).warn_of_images(model.warnings);
    warn_of_harmless_faults(file, tree, model.warnings);
    warn_of_accessors(parsed, tree, model.warnings);
    return model;
}

} // namespace sahl

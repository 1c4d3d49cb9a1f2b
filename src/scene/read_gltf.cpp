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

    model.materials = gltf_materials(tree);
    model.meshes = gltf_meshes(parsed, model.materials, file.name(), model.warnings);
    model.instances = gltf_instances(parsed, file.name(), model.warnings);
    if (tree.find("animations"))
        model.warnings.push_back(file.name() +
                                 ": animations are left out: nodes stand where they are at rest");
    return model;
}

} // namespace sahl

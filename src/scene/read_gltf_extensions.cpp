// In: the tree of a glTF file that has been read. Out: warnings of extensions that are no objects, that
// nothing declares, or that stand where they mean nothing.
#include "scene/read_gltf_faults.h"

#include <unordered_set>

namespace sahl {

namespace {

/// Where an extension may stand; the last key of the object that holds its "extensions".
bool belongs(std::string const& extension, std::vector<std::string> const& path) {
    bool const material = path.size() == 2 && path[0] == "materials";
    if (extension.rfind("KHR_materials_", 0) == 0)
        return material || extension == "KHR_materials_variants";
    if (extension == "KHR_texture_transform")
        return !path.empty() && path.back().size() >= 7 &&
               path.back().compare(path.back().size() - 7, 7, "Texture") == 0;
    if (extension == "EXT_mesh_gpu_instancing")
        return path.size() == 2 && path[0] == "nodes";
    if (extension == "KHR_lights_punctual")
        return path.empty() || (path.size() == 2 && path[0] == "nodes");
    return true;
}

struct ExtensionWalk {
    std::unordered_set<std::string> declared;
    GltfFaults& faults;
    std::vector<std::string> path{};

    void check(Value const& extensions) {
        auto const* const table = std::get_if<Table>(&extensions.data);
        if (!table)
            return faults.add(extensions.place, "this must be an object; it is left out");
        for (auto const& [name, value] : *table) {
            if (!std::holds_alternative<Table>(value.data))
                faults.add(value.place, "this must be an object; it is left out");
            if (!declared.count(name))
                faults.add(value.place, "extensionsUsed does not name this extension");
            if (!belongs(name, path))
                faults.add(value.place, "this extension means nothing here, and is left out");
        }
    }
    void walk(Value const& value) { // no deeper than the JSON, which is at most 256
        auto const step = [&](std::string const& key, Value const& entry) {
            if (!std::holds_alternative<Table>(entry.data) && !std::holds_alternative<Array>(entry.data))
                return;
            path.push_back(key);
            walk(entry);
            path.pop_back();
        };
        if (auto const* const table = std::get_if<Table>(&value.data)) {
            for (auto const& [key, entry] : *table)
                if (key == "extensions")
                    check(entry);
                else if (key != "extras")
                    step(key, entry);
        } else if (auto const* const array = std::get_if<Array>(&value.data)) {
            for (Value const& entry : *array)
                step("*", entry);
        }
    }
};

} // namespace

void check_gltf_extensions(Value const& tree, GltfFaults& faults) {
    ExtensionWalk walk{{}, faults};
    for (Value const& name : gltf_entries(tree, "extensionsUsed"))
        if (!walk.declared.insert(std::get<std::string>(name.data)).second)
            faults.add(name.place, "this extension is named twice");
    walk.walk(tree);
    Value const* const root = tree.find("extensions");
    if (Value const* const lights = gltf::find(root, "KHR_lights_punctual"))
        if (gltf_entries(*lights, "lights").empty())
            faults.add(lights->place, "it has no lights");
}

} // namespace sahl

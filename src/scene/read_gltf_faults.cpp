// In: a glTF file that has been read. Out: warnings of what is wrong with it where that cannot change the
// light. Faults that can are errors of the readers. What the specification asks is its section 5, and 4.4 for
// .glb.
#include "scene/read_gltf_faults.h"

#include <cmath>

namespace sahl {

namespace {

bool is_integer(Value const* value, std::int64_t number) {
    auto const* const integer = value ? std::get_if<std::int64_t>(&value->data) : nullptr;
    return integer && *integer == number;
}

constexpr std::string_view collections[] = {"accessors", "animations", "buffers", "bufferViews", "cameras",
                                            "images",    "materials",  "meshes",  "nodes",       "samplers",
                                            "scenes",    "skins",      "textures"};

void check_collections(Value const& tree, GltfFaults& faults) {
    for (std::string_view const key : collections) {
        Value const* const list = tree.find(key);
        auto const* const array = list ? std::get_if<Array>(&list->data) : nullptr;
        if (list && !array)
            faults.add(list->place, "this must be an array; it is left out");
        else if (array && array->empty())
            faults.add(list->place, "it is empty, which glTF does not allow");
    }
    for (auto const& [key, what] :
         {std::pair{"animations", "animations are left out: nodes stand where they are at rest"},
          std::pair{"skins", "skins are left out: meshes have their rest shape"}})
        if (!gltf_entries(tree, key).empty())
            faults.add(tree.find(key)->place, what);
}

bool refers_to_nothing(Value const* index, std::size_t count) {
    auto const* const number = index ? std::get_if<std::int64_t>(&index->data) : nullptr;
    return index && (!number || *number < 0 || static_cast<std::size_t>(*number) >= count);
}

/// Nodes that nothing leads to may be wrong without harm.
void check_nodes(Value const& tree, GltfFaults& faults) {
    Array const& nodes = gltf_entries(tree, "nodes");
    std::vector<std::int64_t> parent(nodes.size(), -1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (auto const& [key, list] :
             {std::pair{"mesh", "meshes"}, std::pair{"camera", "cameras"}, std::pair{"skin", "skins"}})
            if (Value const* const index = nodes[i].find(key);
                refers_to_nothing(index, gltf_entries(tree, list).size()))
                faults.add(index->place, "there is no such " + std::string(key));
        for (Value const& child : gltf_entries(nodes[i], "children")) {
            if (refers_to_nothing(&child, nodes.size())) {
                faults.add(child.place, "there is no such node");
                continue;
            }
            auto& of_child = parent[static_cast<std::size_t>(std::get<std::int64_t>(child.data))];
            if (of_child >= 0)
                faults.add(child.place, "this node has another parent already");
            of_child = static_cast<std::int64_t>(i);
        }
        if (nodes[i].find("matrix") &&
            (nodes[i].find("translation") || nodes[i].find("rotation") || nodes[i].find("scale")))
            faults.add(nodes[i].place, "a matrix and a translation, rotation or scale stand together");
        Array const& turn = gltf_entries(nodes[i], "rotation");
        double squared = turn.size() == 4 ? 0.0 : 1.0;
        for (Value const& part : turn)
            squared += gltf::at_least(&part, -2.0, 0.0, "") * gltf::at_least(&part, -2.0, 0.0, "");
        if (turn.size() == 4 && std::abs(squared - 1.0) > 2e-3)
            faults.add(turn.front().place, "the quaternion is not of length 1");
    }
    if (Value const* const scene = tree.find("scene");
        refers_to_nothing(scene, gltf_entries(tree, "scenes").size()))
        faults.add(scene->place, "there is no such scene");
    for (Value const& scene : gltf_entries(tree, "scenes"))
        for (Value const& node : gltf_entries(scene, "nodes")) {
            if (refers_to_nothing(&node, nodes.size()))
                faults.add(node.place, "there is no such node");
            else if (parent[static_cast<std::size_t>(std::get<std::int64_t>(node.data))] >= 0)
                faults.add(node.place, "this node has a parent: it is no root");
        }
    std::vector<std::size_t> seen(nodes.size(), 0); // by which walk towards the root, from 1
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (std::int64_t at = static_cast<std::int64_t>(i); at >= 0;
             at = parent[static_cast<std::size_t>(at)]) {
            std::size_t& stamp = seen[static_cast<std::size_t>(at)];
            if (stamp == i + 1)
                faults.add(nodes[static_cast<std::size_t>(at)].place, "its children lead back to it");
            if (stamp != 0)
                break;
            stamp = i + 1;
        }
}

bool is_known_attribute(std::string const& name) {
    if (name == "POSITION" || name == "NORMAL" || name == "TANGENT" || name.rfind('_', 0) == 0)
        return true;
    std::size_t const bar = name.rfind('_');
    if (bar == std::string::npos)
        return false;
    std::string const stem = name.substr(0, bar), number = name.substr(bar + 1);
    bool const digits = !number.empty() && number.find_first_not_of("0123456789") == std::string::npos &&
                        (number == "0" || number.front() != '0');
    return digits && (stem == "TEXCOORD" || stem == "COLOR" || stem == "JOINTS" || stem == "WEIGHTS");
}

void check_attributes(Value const& tree, GltfFaults& faults) {
    Array const& accessors = gltf_entries(tree, "accessors");
    bool colours = false, weights = false;
    for_each_match(tree, "/meshes/*/primitives/*/attributes", [&](Value const& attributes) {
        for (auto const& [name, index] : std::get<Table>(attributes.data)) {
            if (refers_to_nothing(&index, accessors.size())) {
                faults.add(index.place, "there is no such accessor");
                continue;
            }
            if (!is_known_attribute(name))
                faults.add(index.place, "glTF has no such attribute; it is left out");
            Value const& accessor = accessors[static_cast<std::size_t>(std::get<std::int64_t>(index.data))];
            Value const* const type = accessor.find("componentType");
            if (is_integer(type, 5125))
                faults.add(index.place, "an attribute may not consist of 32-bit integers");
            colours = colours || name.rfind("COLOR_", 0) == 0;
            weights = weights || name.rfind("JOINTS_", 0) == 0 || name.rfind("WEIGHTS_", 0) == 0;
        }
    });
    Place const meshes{tree.place.file, 0, 0, "/meshes"};
    if (colours)
        faults.add(meshes, "vertex colours are not modelled: a material's factors are taken for all of it");
    if (weights)
        faults.add(meshes, "joints and weights are left out: meshes have their rest shape");
    for_each_match(tree, "/meshes/*", [&](Value const& mesh) {
        if (mesh.find("weights"))
            faults.add(mesh.find("weights")->place, "weights of morph targets are left out");
    });
    Array const& views = gltf_entries(tree, "bufferViews");
    for_each_match(tree, "/meshes/*/primitives/*/indices", [&](Value const& index) {
        if (refers_to_nothing(&index, accessors.size()))
            return;
        Value const* const view =
            accessors[static_cast<std::size_t>(std::get<std::int64_t>(index.data))].find("bufferView");
        if (view && !refers_to_nothing(view, views.size()) &&
            views[static_cast<std::size_t>(std::get<std::int64_t>(view->data))].find("byteStride"))
            faults.add(index.place, "indices may not have a byteStride; it is honoured");
    });
}

void check_views(Value const& tree, GltfFaults& faults) {
    for (Value const& view : gltf_entries(tree, "bufferViews")) {
        Value const* const stride = view.find("byteStride");
        Value const* const target = view.find("target");
        if (!stride)
            continue;
        std::int64_t const bytes = std::get<std::int64_t>(stride->data);
        if (bytes < 4 || bytes > 252 || bytes % 4 != 0)
            faults.add(stride->place, "a stride must be a multiple of 4 from 4 to 252");
        if (is_integer(target, 34963))
            faults.add(stride->place, "a view of indices may have no stride");
        Value const* const length = view.find("byteLength");
        if (length && std::get<std::int64_t>(length->data) < bytes)
            faults.add(stride->place, "the stride is longer than the view");
    }
}

void check_container(GltfFile const& file, Value const& tree, GltfFaults& faults) {
    Place const place{file.name(), 0, 0, {}};
    if (file.json().substr(0, 3) == "\xEF\xBB\xBF")
        faults.add(place, "its JSON begins with a byte order mark");
    if (file.json_begin == 0)
        return;
    for (std::string const& fault : file.faults)
        faults.add(place, fault);
    Array const& buffers = gltf_entries(tree, "buffers");
    Value const* const length = buffers.empty() ? nullptr : buffers.front().find("byteLength");
    if (length && !buffers.front().find("uri") && file.bin_size > 0 &&
        file.bin_size > static_cast<std::uint64_t>(std::get<std::int64_t>(length->data)) + 3)
        faults.add(buffers.front().place, "its BIN chunk has " + std::to_string(file.bin_size) +
                                              " bytes, more than byteLength says");
}

} // namespace

void warn_of_harmless_faults(GltfFile const& file, Value const& tree, std::vector<std::string>& warnings) {
    GltfFaults faults{warnings};
    check_container(file, tree, faults);
    check_collections(tree, faults);
    check_gltf_extensions(tree, faults);
    check_nodes(tree, faults);
    check_attributes(tree, faults);
    check_views(tree, faults);
    if (faults.told > GltfFaults::most)
        warnings.push_back(file.name() + ": and " + std::to_string(faults.told - GltfFaults::most) +
                           " more faults of the file");
}

} // namespace sahl

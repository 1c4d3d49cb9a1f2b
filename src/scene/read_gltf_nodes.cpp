// In: tinygltf's scenes and nodes. Out: where each mesh stands. Walked without recursion; each node once.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <tiny_gltf.h>

#include <cmath>
#include <memory>
#include <utility>

namespace sahl {

namespace {

constexpr std::size_t most_instances = 100'000; // each becomes an object of its own

/// The rotation of a quaternion x, y, z, w. One that is off unit length by more than hand-written digits is
/// refused.
dmat3 rotation_of(std::vector<double> const& q, std::string const& place) {
    double const size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(std::abs(size - 1.0) < 1e-3))
        throw InputError(place, "the quaternion's length is " + std::to_string(size), "make it 1");
    double const x = q[0] / size, y = q[1] / size, z = q[2] / size, w = q[3] / size;
    return {dvec3(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
            dvec3(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
            dvec3(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y))};
}

/// Scale, then turn, then move; empty lists leave that out.
Affine affine_of(std::vector<double> const& move, std::vector<double> const& turn,
                 std::vector<double> const& scale, std::string const& turn_place) {
    Affine map;
    if (!turn.empty())
        map.linear = rotation_of(turn, turn_place);
    if (!scale.empty())
        for (int axis = 0; axis < 3; ++axis)
            map.linear[axis] *= scale[static_cast<std::size_t>(axis)];
    if (!move.empty())
        map.offset = {move[0], move[1], move[2]};
    return map;
}

Affine local_transform(tinygltf::Node const& node, std::string const& place) {
    auto const& m = node.matrix;
    if (!m.empty() && !(node.translation.empty() && node.rotation.empty() && node.scale.empty()))
        throw InputError(place + "/matrix", "a matrix and a translation, rotation or scale stand together",
                         "keep one of the two");
    if (m.empty())
        return affine_of(node.translation, node.rotation, node.scale, place + "/rotation");
    if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0)
        throw InputError(place + "/matrix", "its last row is not 0, 0, 0, 1",
                         "give an affine matrix, column by column");
    return {dmat3(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]), dvec3(m[12], m[13], m[14])};
}

bool is_finite(Affine const& map) {
    double sum = map.offset.x + map.offset.y + map.offset.z;
    for (int i = 0; i < 3; ++i)
        sum += map.linear[i].x + map.linear[i].y + map.linear[i].z;
    return std::isfinite(sum);
}

/// The copies of a node's mesh that EXT_mesh_gpu_instancing places in the node's frame; one at its origin
/// without it.
std::vector<Affine> copies_of(tinygltf::Model const& model, tinygltf::Node const& node,
                              std::string const& node_place, AccessorBudget& budget) {
    auto const extension = node.extensions.find("EXT_mesh_gpu_instancing");
    if (extension == node.extensions.end() || !extension->second.Has("attributes"))
        return {Affine()};
    tinygltf::Value const& attributes = extension->second.Get("attributes");
    std::string const place = node_place + "/extensions/EXT_mesh_gpu_instancing/attributes";
    std::size_t count = 0;
    auto const read = [&](char const* name, int components) {
        if (!attributes.Has(name))
            return std::vector<double>();
        auto numbers =
            accessor_numbers(model, attributes.Get(name).GetNumberAsInt(), components, place, budget);
        std::size_t const here = numbers.size() / static_cast<std::size_t>(components);
        if (count != 0 && here != count)
            throw InputError(place, "its lists differ in length", "export the file again");
        count = here;
        return numbers;
    };
    auto const moves = read("TRANSLATION", 3), turns = read("ROTATION", 4), scales = read("SCALE", 3);
    if (count > most_instances)
        throw InputError(place, "there are more than 100000 instances", "split the model");
    auto const part = [](std::vector<double> const& all, std::size_t i, std::ptrdiff_t width) {
        auto const begin = all.begin() + static_cast<std::ptrdiff_t>(i) * width;
        return all.empty() ? std::vector<double>() : std::vector<double>(begin, begin + width);
    };
    std::vector<Affine> copies;
    for (std::size_t i = 0; i < count; ++i)
        copies.push_back(
            affine_of(part(moves, i, 3), part(turns, i, 4), part(scales, i, 3), place + "/ROTATION"));
    return copies;
}

/// The nodes that nothing holds: those of the scene, or, without scenes, those that are no node's child.
std::vector<int> roots_of(tinygltf::Model const& model, std::string const& file) {
    if (!model.scenes.empty()) {
        std::size_t const scene = static_cast<std::size_t>(std::max(0, model.defaultScene));
        if (scene >= model.scenes.size())
            throw InputError(file + ": /scene", "there is no scene " + std::to_string(scene),
                             "export the file again");
        return model.scenes[scene].nodes;
    }
    std::vector<bool> is_child(model.nodes.size(), false);
    for (tinygltf::Node const& node : model.nodes)
        for (int const child : node.children)
            if (static_cast<std::size_t>(child) < is_child.size())
                is_child[static_cast<std::size_t>(child)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        if (!is_child[i])
            roots.push_back(static_cast<int>(i));
    return roots;
}

constexpr std::uint32_t no_parent = 0xFFFFFFFFu;
constexpr std::size_t most_groups = 32; // names of parents by which an instance can be asked for

struct Step {
    int node;
    Affine to_parent;
    std::uint32_t parent;
};

struct Walk {
    tinygltf::Model const& model;
    Value const& tree;
    std::vector<std::string>& warnings;
    std::vector<std::uint32_t> parent_of; // by node
    AccessorBudget budget{};
    GltfScene scene{};

    std::string place(std::size_t node) const { return tree.place.file + ": /nodes/" + std::to_string(node); }
    std::string name(std::size_t node) const {
        return model.nodes[node].name.empty() ? "node_" + std::to_string(node)
                                              : gltf::short_name(model.nodes[node].name);
    }
    std::vector<std::string> groups(std::uint32_t node) const;
    void place_mesh(std::size_t number, Affine const& to_world);
};

/// The names of a node's parents, nearest first.
std::vector<std::string> Walk::groups(std::uint32_t node) const {
    std::vector<std::string> names;
    for (node = parent_of[node]; node != no_parent && names.size() < most_groups; node = parent_of[node])
        if (!model.nodes[node].name.empty())
            names.push_back(gltf::short_name(model.nodes[node].name));
    return names;
}

/// Places a node's mesh, as often as it asks for.
void Walk::place_mesh(std::size_t number, Affine const& to_world) {
    tinygltf::Node const& node = model.nodes[number];
    std::string const here = place(number);
    if (static_cast<std::size_t>(node.mesh) >= model.meshes.size())
        throw InputError(here + "/mesh", "there is no mesh " + std::to_string(node.mesh),
                         "export the file again");
    if (node.skin >= 0)
        warnings.push_back(here + "/skin: skins are left out: the mesh has its rest shape");
    std::vector<Affine> const copies = copies_of(model, node, here, budget);
    ModelNode about{groups(static_cast<std::uint32_t>(number)),
                    gltf::extras_of(std::get<Array>(tree.find("nodes")->data)[number])};
    if (copies.size() != 1)
        about.groups.insert(about.groups.begin(), name(number));
    ModelInstance instance{name(number),
                           {},
                           static_cast<std::uint32_t>(node.mesh),
                           std::make_shared<ModelNode const>(std::move(about))};
    for (std::size_t i = 0; i < copies.size(); ++i) {
        instance.to_world = compose(to_world, copies[i]);
        if (!is_finite(instance.to_world))
            throw InputError(here, "its transform, with its parents', is not finite",
                             "make the numbers smaller");
        if (glm::determinant(instance.to_world.linear) == 0.0 || !is_finite(inverse(instance.to_world))) {
            warnings.push_back(here + ": it is flattened by a scale of 0, and left out");
            continue;
        }
        if (scene.instances.size() == most_instances)
            throw InputError(here, "there are more than 100000 instances", "split the model");
        if (copies.size() != 1)
            instance.name = name(number) + "_" + std::to_string(i);
        scene.instances.push_back(instance);
    }
}

bool has_camera_or_light(tinygltf::Node const& node) {
    return node.camera >= 0 || node.extensions.count("KHR_lights_punctual") > 0;
}

} // namespace

GltfScene gltf_scene(tinygltf::Model const& model, Value const& tree, std::vector<std::string>& warnings) {
    std::string const& file = tree.place.file;
    Walk walk{model, tree, warnings, std::vector<std::uint32_t>(model.nodes.size(), no_parent)};
    std::vector<bool> seen(model.nodes.size(), false);
    std::vector<Step> stack;
    auto const push = [&](std::vector<int> const& nodes, Affine const& to_parent, std::uint32_t parent) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
            stack.push_back({*node, to_parent, parent});
    };
    push(roots_of(model, file), Affine(), no_parent);
    while (!stack.empty()) {
        Step const step = stack.back();
        stack.pop_back();
        std::size_t const number = static_cast<std::size_t>(step.node);
        if (step.node < 0 || number >= seen.size())
            throw InputError(step.parent == no_parent ? file + ": /scenes"
                                                      : walk.place(step.parent) + "/children",
                             "there is no node " + std::to_string(step.node), "export the file again");
        if (seen[number])
            throw InputError(walk.place(number),
                             "more than one path leads to it, and glTF's nodes form a tree",
                             "give each parent a node of its own; they may share a mesh");
        seen[number] = true;
        walk.parent_of[number] = step.parent;
        tinygltf::Node const& node = model.nodes[number];
        Affine const to_world = compose(step.to_parent, local_transform(node, walk.place(number)));
        if (node.mesh >= 0)
            walk.place_mesh(number, to_world);
        if (has_camera_or_light(node))
            walk.scene.others.push_back({number, to_world});
        push(node.children, to_world, static_cast<std::uint32_t>(number));
    }
    if (walk.scene.instances.empty())
        warnings.push_back(file + ": no node of its scene places a mesh");
    return std::move(walk.scene);
}

} // namespace sahl

// In: tinygltf's scenes and nodes. Out: where each mesh stands. Walked without recursion; each node once.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <tiny_gltf.h>

#include <cmath>

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

struct Step {
    int node;
    Affine parent;
    std::string from; // place of what refers to it
};

/// Places a node's mesh, as often as it asks for.
void place_mesh(tinygltf::Model const& model, tinygltf::Node const& node, std::size_t number,
                Affine const& to_world, std::string const& place, AccessorBudget& budget,
                std::vector<ModelInstance>& instances, std::vector<std::string>& warnings) {
    if (static_cast<std::size_t>(node.mesh) >= model.meshes.size())
        throw InputError(place + "/mesh", "there is no mesh " + std::to_string(node.mesh),
                         "export the file again");
    if (node.skin >= 0)
        warnings.push_back(place + "/skin: skins are left out: the mesh has its rest shape");
    std::string const name = node.name.empty() ? "node_" + std::to_string(number) : node.name;
    std::vector<Affine> const copies = copies_of(model, node, place, budget);
    for (std::size_t i = 0; i < copies.size(); ++i) {
        Affine const map = compose(to_world, copies[i]);
        if (!is_finite(map))
            throw InputError(place, "its transform, with its parents', is not finite",
                             "make the numbers smaller");
        if (glm::determinant(map.linear) == 0.0 || !is_finite(inverse(map))) {
            warnings.push_back(place + ": it is flattened by a scale of 0, and left out");
            continue;
        }
        if (instances.size() == most_instances)
            throw InputError(place, "there are more than 100000 instances", "split the model");
        instances.push_back({copies.size() == 1 ? name : name + "_" + std::to_string(i), map,
                             static_cast<std::uint32_t>(node.mesh)});
    }
}

} // namespace

std::vector<ModelInstance> gltf_instances(tinygltf::Model const& model, std::string const& file,
                                          std::vector<std::string>& warnings) {
    std::vector<ModelInstance> instances;
    std::vector<bool> seen(model.nodes.size(), false);
    std::vector<Step> stack;
    AccessorBudget budget;
    auto const push = [&](std::vector<int> const& nodes, Affine const& parent, std::string const& from) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
            stack.push_back({*node, parent, from});
    };
    push(roots_of(model, file), Affine(), file + ": /scenes");
    while (!stack.empty()) {
        Step const step = stack.back();
        stack.pop_back();
        std::size_t const number = static_cast<std::size_t>(step.node);
        std::string const place = file + ": /nodes/" + std::to_string(step.node);
        if (step.node < 0 || number >= seen.size())
            throw InputError(step.from, "there is no node " + std::to_string(step.node),
                             "export the file again");
        if (seen[number])
            throw InputError(place, "more than one path leads to it, and glTF's nodes form a tree",
                             "give each parent a node of its own; they may share a mesh");
        seen[number] = true;
        tinygltf::Node const& node = model.nodes[number];
        Affine const to_world = compose(step.parent, local_transform(node, place));
        if (node.mesh >= 0)
            place_mesh(model, node, number, to_world, place, budget, instances, warnings);
        push(node.children, to_world, place + "/children");
    }
    if (instances.empty())
        warnings.push_back(file + ": no node of its scene places a mesh");
    return instances;
}

} // namespace sahl

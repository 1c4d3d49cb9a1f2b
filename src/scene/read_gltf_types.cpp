// In: the tree of a glTF file's JSON. Out: nothing, or an InputError where a value is not of its type.
// tinygltf passes over wrong types in silence, and cuts integers to 32 bits: both are refused here.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <cmath>
#include <limits>

namespace sahl {

namespace {

enum class Kind { object, array, string, boolean, number, index, size };

struct Rule {
    std::string_view pattern; // as a JSON pointer; * stands for every entry
    Kind kind;
    std::size_t length = 0; // of an array; 0: any
};

// clang-format off
constexpr Rule rules[] = {
    {"/asset", Kind::object}, {"/asset/version", Kind::string}, {"/asset/minVersion", Kind::string}, {"/extensionsUsed", Kind::array},
    {"/extensionsUsed/*", Kind::string}, {"/extensionsRequired", Kind::array},
    {"/extensionsRequired/*", Kind::string}, {"/scene", Kind::index}, {"/scenes", Kind::array},
    {"/scenes/*", Kind::object}, {"/scenes/*/nodes", Kind::array}, {"/scenes/*/nodes/*", Kind::index},
    {"/nodes", Kind::array}, {"/nodes/*", Kind::object}, {"/nodes/*/name", Kind::string},
    {"/nodes/*/mesh", Kind::index}, {"/nodes/*/skin", Kind::index}, {"/nodes/*/children", Kind::array},
    {"/nodes/*/children/*", Kind::index}, {"/nodes/*/matrix", Kind::array, 16},
    {"/nodes/*/matrix/*", Kind::number}, {"/nodes/*/translation", Kind::array, 3},
    {"/nodes/*/translation/*", Kind::number}, {"/nodes/*/rotation", Kind::array, 4},
    {"/nodes/*/rotation/*", Kind::number}, {"/nodes/*/scale", Kind::array, 3},
    {"/nodes/*/scale/*", Kind::number}, {"/nodes/*/extensions", Kind::object},
    {"/nodes/*/extensions/EXT_mesh_gpu_instancing", Kind::object},
    {"/nodes/*/extensions/EXT_mesh_gpu_instancing/attributes", Kind::object},
    {"/nodes/*/extensions/EXT_mesh_gpu_instancing/attributes/*", Kind::index}, {"/meshes", Kind::array},
    {"/meshes/*", Kind::object}, {"/meshes/*/name", Kind::string}, {"/meshes/*/primitives", Kind::array},
    {"/meshes/*/primitives/*", Kind::object}, {"/meshes/*/primitives/*/mode", Kind::index},
    {"/meshes/*/primitives/*/indices", Kind::index}, {"/meshes/*/primitives/*/material", Kind::index},
    {"/meshes/*/primitives/*/attributes", Kind::object}, {"/meshes/*/primitives/*/attributes/*", Kind::index},
    {"/accessors", Kind::array}, {"/accessors/*", Kind::object}, {"/accessors/*/bufferView", Kind::index},
    {"/accessors/*/byteOffset", Kind::size}, {"/accessors/*/componentType", Kind::index},
    {"/accessors/*/count", Kind::size}, {"/accessors/*/type", Kind::string},
    {"/accessors/*/normalized", Kind::boolean}, {"/accessors/*/sparse", Kind::object},
    {"/accessors/*/sparse/count", Kind::index}, {"/accessors/*/sparse/indices", Kind::object},
    {"/accessors/*/sparse/indices/bufferView", Kind::index},
    {"/accessors/*/sparse/indices/byteOffset", Kind::index},
    {"/accessors/*/sparse/indices/componentType", Kind::index}, {"/accessors/*/sparse/values", Kind::object},
    {"/accessors/*/sparse/values/bufferView", Kind::index},
    {"/accessors/*/sparse/values/byteOffset", Kind::index}, {"/bufferViews", Kind::array},
    {"/bufferViews/*", Kind::object}, {"/bufferViews/*/buffer", Kind::index},
    {"/bufferViews/*/byteOffset", Kind::size}, {"/bufferViews/*/byteLength", Kind::size},
    {"/bufferViews/*/byteStride", Kind::index}, {"/buffers", Kind::array}, {"/buffers/*", Kind::object},
    {"/buffers/*/byteLength", Kind::size}, {"/buffers/*/uri", Kind::string}, {"/materials", Kind::array},
    {"/materials/*", Kind::object}, {"/materials/*/name", Kind::string},
    {"/materials/*/alphaMode", Kind::string}, {"/materials/*/doubleSided", Kind::boolean},
    {"/materials/*/pbrMetallicRoughness", Kind::object},
    {"/materials/*/pbrMetallicRoughness/baseColorFactor", Kind::array, 4},
    {"/materials/*/pbrMetallicRoughness/baseColorFactor/*", Kind::number},
    {"/materials/*/pbrMetallicRoughness/metallicFactor", Kind::number},
    {"/materials/*/pbrMetallicRoughness/roughnessFactor", Kind::number},
    {"/materials/*/extensions", Kind::object}, {"/materials/*/extensions/*", Kind::object},
    {"/materials/*/alphaCutoff", Kind::number},
    {"/materials/*/extensions/KHR_materials_specular/specularFactor", Kind::number},
    {"/materials/*/extensions/KHR_materials_specular/specularColorFactor", Kind::array, 3},
    {"/materials/*/extensions/KHR_materials_specular/specularColorFactor/*", Kind::number},
    {"/materials/*/extensions/KHR_materials_ior/ior", Kind::number},
    {"/materials/*/extensions/KHR_materials_transmission/transmissionFactor", Kind::number},
    {"/materials/*/extensions/KHR_materials_dispersion/dispersion", Kind::number},
    {"/materials/*/extensions/KHR_materials_volume/thicknessFactor", Kind::number},
    {"/materials/*/extensions/KHR_materials_volume/attenuationDistance", Kind::number},
    {"/materials/*/extensions/KHR_materials_volume/attenuationColor", Kind::array, 3},
    {"/materials/*/extensions/KHR_materials_volume/attenuationColor/*", Kind::number},
};
// clang-format on

/// What must be there if the entry that holds it is.
constexpr std::pair<std::string_view, std::string_view> required[] = {
    {"", "asset"},
    {"/asset", "version"},
    {"/meshes/*", "primitives"},
    {"/meshes/*/primitives/*", "attributes"},
    {"/accessors/*", "componentType"},
    {"/accessors/*", "count"},
    {"/accessors/*", "type"},
    {"/accessors/*/sparse", "count"},
    {"/accessors/*/sparse", "indices"},
    {"/accessors/*/sparse", "values"},
    {"/accessors/*/sparse/indices", "bufferView"},
    {"/accessors/*/sparse/indices", "componentType"},
    {"/accessors/*/sparse/values", "bufferView"},
    {"/bufferViews/*", "buffer"},
    {"/bufferViews/*", "byteLength"},
    {"/buffers/*", "byteLength"},
};

std::string_view name_of(Kind kind) {
    constexpr std::string_view names[] = {"an object",
                                          "an array",
                                          "a string",
                                          "true or false",
                                          "a finite number",
                                          "an integer from 0 to 2147483647",
                                          "an integer from 0 to 2^53"};
    return names[static_cast<int>(kind)];
}

bool is_of(Value const& value, Kind kind) {
    auto const* integer = std::get_if<std::int64_t>(&value.data);
    auto const* real = std::get_if<double>(&value.data);
    switch (kind) {
    case Kind::object:
        return std::holds_alternative<Table>(value.data);
    case Kind::array:
        return std::holds_alternative<Array>(value.data);
    case Kind::string:
        return std::holds_alternative<std::string>(value.data);
    case Kind::boolean:
        return std::holds_alternative<bool>(value.data);
    case Kind::number:
        return integer || (real && std::isfinite(*real));
    case Kind::index:
        return integer && *integer >= 0 && *integer <= std::numeric_limits<std::int32_t>::max();
    case Kind::size:
        return integer && *integer >= 0 && *integer <= std::int64_t{1} << 53;
    }
    return false;
}

} // namespace

void check_gltf_types(Value const& tree) {
    for (Rule const& rule : rules)
        for_each_match(tree, rule.pattern, [&](Value const& value) {
            if (!is_of(value, rule.kind))
                throw InputError(value.place.text(), "this must be " + std::string(name_of(rule.kind)),
                                 "correct it, or export the file again");
            if (rule.length != 0 && std::get<Array>(value.data).size() != rule.length)
                throw InputError(value.place.text(),
                                 "this must have " + std::to_string(rule.length) + " numbers",
                                 "correct it, or export the file again");
        });
    for (auto const& need : required)
        for_each_match(tree, need.first, [&](Value const& value) {
            if (!value.find(need.second))
                throw InputError(value.place.text(), "it has no " + std::string(need.second),
                                 "export the file again");
        });
}

} // namespace sahl

// In: a glTF file, step by step: bytes, JSON, tinygltf's model. Out: the parts of a Model.
// Shared by read_gltf*.cpp alone.
#pragma once

#include "scene/model.h"
#include "scene/value.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tinygltf {
class Model;
}

namespace sahl {

constexpr std::uint64_t gltf_file_budget = std::uint64_t{1}
                                           << 30; // bytes: of the file, and of all its buffers

/// The name under which a primitive's indices are found among its attributes, see read_gltf_buffers.cpp.
constexpr char const* gltf_indices_attribute = "_INDICES_OF_PRIMITIVE";

/// A file's bytes, and where in them the JSON is.
struct GltfFile {
    std::filesystem::path path;
    std::vector<unsigned char> bytes;
    std::size_t json_begin = 0, json_size = 0;
    std::size_t bin_begin = 0, bin_size = 0; // of a .glb's binary chunk; size 0: none
    std::vector<std::string> faults{};       // of a .glb's chunks, none of them in the way of reading

    std::string name() const { return path.string(); }
    std::string_view json() const {
        return {reinterpret_cast<char const*>(bytes.data()) + json_begin, json_size};
    }
};

/// The first `wanted` bytes of a regular file, or all where it is shorter; `place` is what a message starts
/// with.
std::vector<unsigned char> read_bytes(std::filesystem::path const& path, std::uint64_t wanted,
                                      std::string const& place);

/// Reads the file and finds its JSON: told by its first bytes, not by its ending.
GltfFile read_gltf_file(std::filesystem::path const& path);

/// Calls `visit` with each value that `pattern` matches: a JSON pointer in which * stands for every entry.
template <class Visit>
void for_each_match(Value const& value, std::string_view pattern, Visit const& visit) {
    if (pattern.empty())
        return visit(value);
    std::size_t const end = std::min(pattern.find('/', 1), pattern.size());
    std::string_view const key = pattern.substr(1, end - 1), rest = pattern.substr(end);
    auto const* array = std::get_if<Array>(&value.data);
    auto const* table = std::get_if<Table>(&value.data);
    if (key == "*" && array)
        for (Value const& entry : *array)
            for_each_match(entry, rest, visit);
    else if (key == "*" && table)
        for (auto const& entry : *table)
            for_each_match(entry.second, rest, visit);
    else if (Value const* entry = table ? value.find(key) : nullptr)
        for_each_match(*entry, rest, visit);
}

/// Throws InputError where a value is not of the type that glTF 2.0 gives it, or is missing.
void check_gltf_types(Value const& tree);

/// The tree of the file's JSON, every value that is used of the type that it should be; required extensions
/// known. Adds a warning for each extension that is not modelled.
Value checked_gltf_tree(GltfFile const& file, std::vector<std::string>& warnings);

/// tinygltf's view of a checked file, its buffers loaded. Files other than the buffers are not opened, images
/// not decoded.
tinygltf::Model load_gltf(GltfFile const& file, Value const& tree);

/// What all accessors of one file may still bring in, so that many that share bytes cannot fill the memory.
struct AccessorBudget {
    std::uint64_t numbers = std::uint64_t{1} << 28; // as many floats as the largest file has room for
};

/// The numbers of an accessor, `components` an element, normalised ones divided, sparse ones replaced.
/// `place` is what refers to it. Throws InputError unless all of it lies inside its buffers.
std::vector<double> accessor_numbers(tinygltf::Model const& model, int accessor, int components,
                                     std::string const& place, AccessorBudget& budget);

/// The file that a relative URI names, under `folder` even after links are followed. Throws InputError where
/// there is none.
std::filesystem::path file_of_uri(std::string const& uri, std::filesystem::path const& folder,
                                  std::string const& place);
std::vector<unsigned char> decoded_data_uri(std::string const& uri, std::string const& place);

/// The pictures of a file's materials, the bytes of those within it kept once. What is wrong with one changes
/// no light: it is left as a problem that whoever makes a picture tells.
class GltfTextures {
  public:
    GltfTextures(GltfFile const& file, Value const& tree, tinygltf::Model const& model)
        : file_(file), tree_(tree), model_(model) {}

    /// use   a textureInfo; none where there is none
    std::optional<ModelTexture> of(Value const* use);
    /// Warns of images that are nowhere, whether a material uses them or not; none is opened.
    void warn_of_images(std::vector<std::string>& warnings) const;

  private:
    void find_image(std::uint32_t image, ModelTexture& texture);
    std::span<unsigned char const> bytes_of_view(Value const& image) const;

    GltfFile const& file_;
    Value const& tree_;
    tinygltf::Model const& model_;
    std::map<std::uint32_t, ModelTexture> images_{}; // where each image is
};

std::vector<ModelMaterial> gltf_materials(GltfFile const& file, Value const& tree,
                                          tinygltf::Model const& model);
std::vector<ModelMesh> gltf_meshes(tinygltf::Model const& model, std::vector<ModelMaterial> const& materials,
                                   std::string const& file, std::vector<std::string>& warnings);

/// A node with a camera or a light, and where it stands.
struct PlacedNode {
    std::size_t number = 0;
    Affine to_world;
};

/// What the nodes of the default scene (else of the first; without scenes all) place.
struct GltfScene {
    std::vector<ModelInstance> instances; // of nodes that have a mesh
    std::vector<PlacedNode> others;
};
GltfScene gltf_scene(tinygltf::Model const& model, Value const& tree, std::vector<std::string>& warnings);

/// Cameras and lights of the nodes. One that is wrong is left out, with a warning: no light is traced from
/// it.
void add_cameras_and_lights(Value const& tree, std::vector<PlacedNode> const& nodes, Model& model);

/// Warns of what is wrong where it cannot change where light goes: parts that are not read, or that nothing
/// refers to.
void warn_of_harmless_faults(GltfFile const& file, Value const& tree, std::vector<std::string>& warnings);

/// Warns where accessors that no mesh uses cannot be read, and where bounds are not those of the data.
void warn_of_accessors(tinygltf::Model const& model, Value const& tree, std::vector<std::string>& warnings);

/// Numbers of the tree, with their ranges checked; the place that a message names is the value's own.
namespace gltf {

Value const* find(Value const* table, std::string_view key);
std::string text(double number);
/// The number at `value`, or `otherwise` where there is none. Throws InputError below `low`, or where it is
/// no finite number.
double at_least(Value const* value, double low, double otherwise, std::string const& remedy);
/// [0, 1]
double share(Value const* value, double otherwise);
/// At most 200 bytes: a name is copied for each instance and face.
std::string short_name(std::string const& name);
std::string name_or(Value const& entry, std::string const& otherwise);
/// As JSON; empty where there are none.
std::string extras_of(Value const& entry);

} // namespace gltf

} // namespace sahl

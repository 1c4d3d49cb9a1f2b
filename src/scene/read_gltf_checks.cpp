// In: the bytes of a glTF file. Out: its JSON as a tree, types and extensions checked.
// Values are counted, and views measured, before anything is allocated for them.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <algorithm>

namespace sahl {

namespace {

std::int64_t integer_or_0(Value const* value) {
    return value ? std::get<std::int64_t>(value->data) : 0;
}

/// Every view inside its buffer: offsets and lengths are at most 2^53 here, so that their sum fits.
void check_views(Value const& tree) {
    Value const* list = tree.find("buffers");
    Array const buffers = list ? std::get<Array>(list->data) : Array();
    for_each_match(tree, "/bufferViews/*", [&](Value const& view) {
        std::uint64_t const buffer = static_cast<std::uint64_t>(integer_or_0(view.find("buffer")));
        if (buffer >= buffers.size())
            throw InputError(view.place.text(), "there is no buffer " + std::to_string(buffer),
                             "export the file again");
        std::int64_t const end =
            integer_or_0(view.find("byteOffset")) + integer_or_0(view.find("byteLength"));
        std::int64_t const size = integer_or_0(buffers[buffer].find("byteLength"));
        if (end > size)
            throw InputError(view.place.text(),
                             "it ends at byte " + std::to_string(end) + " of a buffer of " +
                                 std::to_string(size),
                             "export the file again");
    });
}

/// Honoured, or of no effect on where light goes; the second part is what to warn of.
struct KnownExtension {
    std::string_view name, warning;
};
constexpr KnownExtension known_extensions[] = {
    {"KHR_materials_ior", ""},
    {"KHR_materials_transmission", ""},
    {"KHR_materials_volume", ""},
    {"KHR_materials_dispersion", ""},
    {"KHR_mesh_quantization", ""},
    {"EXT_mesh_gpu_instancing", ""},
    {"KHR_materials_specular", "it is left out: reflection follows Fresnel's equations exactly"},
    {"KHR_materials_iridescence", "it is left out: reflection follows Fresnel's equations exactly"},
    {"KHR_materials_unlit", "it is left out"},
    {"KHR_lights_punctual", "lights are left out: name sources in the experiment"},
    {"KHR_texture_transform", "it is left out: textures are not read"},
};

void check_extensions(Value const& tree, std::string const& file, std::vector<std::string>& warnings) {
    auto const known = [](std::string const& name) {
        auto const* const found = std::find_if(std::begin(known_extensions), std::end(known_extensions),
                                               [&](KnownExtension const& one) { return one.name == name; });
        return found == std::end(known_extensions) ? nullptr : found;
    };
    for_each_match(tree, "/extensionsRequired/*", [&](Value const& value) {
        std::string const& name = std::get<std::string>(value.data);
        bool const compressed =
            name.find("draco") != std::string::npos || name.find("meshopt") != std::string::npos;
        if (!known(name))
            throw InputError(value.place.text(),
                             "the file requires " + name + ", which this program does not have",
                             compressed ? "export without compression" : "export without this extension");
    });
    for_each_match(tree, "/extensionsUsed/*", [&](Value const& value) {
        std::string const& name = std::get<std::string>(value.data);
        KnownExtension const* const one = known(name);
        if (!one || !one->warning.empty())
            warnings.push_back(
                file + ": " + name + ": " +
                (one ? std::string(one->warning) : "this extension is not known, and left out"));
    });
}

/// Draco's own accessors have no view: without a plain copy beside it the mesh cannot be read.
void check_for_plain_copy(Value const& tree) {
    auto const refuse_bare = [&](Value const& primitive) {
        Value const* const extensions = primitive.find("extensions");
        Value const* const attributes = primitive.find("attributes");
        if (!extensions || !extensions->find("KHR_draco_mesh_compression") || !attributes->find("POSITION"))
            return;
        std::size_t const position = static_cast<std::size_t>(integer_or_0(attributes->find("POSITION")));
        Value const* const accessors = tree.find("accessors");
        if (accessors && position < std::get<Array>(accessors->data).size() &&
            !std::get<Array>(accessors->data)[position].find("bufferView"))
            throw InputError(primitive.place.text(), "it is stored with KHR_draco_mesh_compression alone",
                             "export without compression");
    };
    for_each_match(tree, "/meshes/*/primitives/*", refuse_bare);
}

/// How many values a JSON text may have: each takes some hundred bytes of the tree.
constexpr std::uint64_t most_values = 1'000'000;

void check_number_of_values(GltfFile const& file) {
    std::uint64_t values = 0;
    bool quoted = false;
    std::string_view const text = file.json();
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (quoted && text[i] == '\\')
            ++i;
        else if (text[i] == '"')
            quoted = !quoted;
        else if (!quoted && (text[i] == ',' || text[i] == '[' || text[i] == '{'))
            ++values;
    }
    if (values > most_values)
        throw InputError(file.name(), "its JSON has more than a million values", "split the model");
}

} // namespace

Value checked_gltf_tree(GltfFile const& file, std::vector<std::string>& warnings) {
    check_number_of_values(file);
    Value tree = parse_json(file.json(), file.name());
    if (!std::holds_alternative<Table>(tree.data))
        throw InputError(file.name(), "this is no glTF: its JSON is not an object", "name a glTF 2.0 file");
    check_gltf_types(tree);
    if (std::string const& version = std::get<std::string>(tree.find("asset")->find("version")->data);
        version.rfind("2.", 0) != 0)
        throw InputError(tree.find("asset")->place.text(), "this is glTF " + version.substr(0, 20),
                         "export as glTF 2.0");
    check_extensions(tree, file.name(), warnings);
    check_for_plain_copy(tree);
    check_views(tree);
    return tree;
}

} // namespace sahl

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

/// Honoured, or of no effect on where light goes, or warned of where a material has it.
constexpr std::string_view known_extensions[] = {
    "KHR_materials_ior",        "KHR_materials_transmission",
    "KHR_materials_volume",     "KHR_materials_dispersion",
    "KHR_materials_specular",   "KHR_materials_iridescence",
    "KHR_materials_clearcoat",  "KHR_materials_sheen",
    "KHR_materials_anisotropy", "KHR_materials_emissive_strength",
    "KHR_materials_unlit",      "KHR_materials_diffuse_transmission",
    "KHR_mesh_quantization",    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",      "KHR_texture_transform",
    "KHR_texture_basisu",       "EXT_texture_webp",
    "EXT_texture_avif",         "KHR_xmp_json_ld",
    "KHR_materials_variants",   "KHR_materials_pbrSpecularGlossiness",
};

/// How to export without a kind of compression.
std::string remedy_for(std::string const& extension) {
    if (extension == "KHR_draco_mesh_compression")
        return "export without compression (Blender: untick Compression), or decode it: gltf-transform cp IN "
               "OUT";
    if (extension.find("meshopt") != std::string::npos)
        return "export without compression (gltfpack: leave out -c and -cc)";
    return "export without this extension";
}

void check_extensions(Value const& tree, std::string const& file, std::vector<std::string>& warnings) {
    auto const known = [](std::string const& name) {
        return std::find(std::begin(known_extensions), std::end(known_extensions), name) !=
               std::end(known_extensions);
    };
    for_each_match(tree, "/extensionsRequired/*", [&](Value const& value) {
        std::string const& name = std::get<std::string>(value.data);
        if (!known(name))
            throw InputError(value.place.text(),
                             "the file requires " + name.substr(0, 100) +
                                 ", which this program does not have",
                             remedy_for(name));
    });
    for_each_match(tree, "/extensionsUsed/*", [&](Value const& value) {
        std::string const& name = std::get<std::string>(value.data);
        if (!known(name))
            warnings.push_back(file + ": the extension " + name.substr(0, 100) +
                               " is not known, and left out");
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
                             remedy_for("KHR_draco_mesh_compression"));
    };
    for_each_match(tree, "/meshes/*/primitives/*", refuse_bare);
}

/// The minor number of version "2.N"; InputError where it is no version 2.
int minor_version(Value const& version) {
    std::string const& text = std::get<std::string>(version.data);
    std::string const digits = text.size() > 2 && text.size() < 6 ? text.substr(2) : "";
    if (text.rfind("2.", 0) != 0 || digits.empty() ||
        digits.find_first_not_of("0123456789") != std::string::npos)
        throw InputError(version.place.text(), "this is glTF " + text.substr(0, 20), "export as glTF 2.0");
    return std::stoi(digits);
}

void check_version(Value const& asset, std::vector<std::string>& warnings) {
    int const minor = minor_version(*asset.find("version"));
    Value const* const least = asset.find("minVersion");
    if (least && minor_version(*least) > minor)
        throw InputError(least->place.text(), "it is above the file's own version", "export as glTF 2.0");
    if (minor > 0)
        warnings.push_back(asset.find("version")->place.text() + ": glTF 2." + std::to_string(minor) +
                           " is read as glTF 2.0: what is new in it is left out");
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
    check_version(*tree.find("asset"), warnings);
    check_extensions(tree, file.name(), warnings);
    check_for_plain_copy(tree);
    check_views(tree);
    return tree;
}

} // namespace sahl

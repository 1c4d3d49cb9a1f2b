// In: the checked tree of a glTF file. Out: tinygltf's model of it, its buffers filled.
// tinygltf parses the structure alone; it is handed no path, no image and no URI. Buffers are read here.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <system_error>

namespace sahl {

namespace {

namespace fs = std::filesystem;

int hex_digit(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

std::string percent_decoded(std::string const& uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0) {
            text += static_cast<char>(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2]));
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

/// The bytes of one buffer; none where it has no data of its own, as the specification allows.
std::vector<unsigned char> bytes_of_buffer(GltfFile const& file, Value const& buffer, bool first,
                                           std::uint64_t size) {
    Value const* const uri = buffer.find("uri");
    std::vector<unsigned char> bytes;
    if (!uri && !(first && file.bin_size > 0))
        return bytes;
    if (!uri) {
        auto const begin = file.bytes.begin() + static_cast<std::ptrdiff_t>(file.bin_begin);
        bytes.assign(begin,
                     begin + static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(size, file.bin_size)));
    } else if (std::string const& text = std::get<std::string>(uri->data); text.rfind("data:", 0) == 0) {
        bytes = decoded_data_uri(text, uri->place.text());
    } else {
        std::string const place = uri->place.text();
        bytes = read_bytes(file_of_uri(text, file.path.parent_path() / ".", place), size, place);
    }
    if (bytes.size() < size)
        throw InputError(buffer.place.text(),
                         "it has " + std::to_string(bytes.size()) + " bytes, byteLength says " +
                             std::to_string(size),
                         "copy or export the file again");
    bytes.resize(size);
    return bytes;
}

std::vector<tinygltf::Buffer> buffers_of(GltfFile const& file, Value const& tree) {
    std::vector<tinygltf::Buffer> buffers;
    Value const* const list = tree.find("buffers");
    std::uint64_t left = gltf_file_budget;
    for (Value const& entry : list ? std::get<Array>(list->data) : Array()) {
        std::uint64_t const size =
            static_cast<std::uint64_t>(std::get<std::int64_t>(entry.find("byteLength")->data));
        if (size > left)
            throw InputError(entry.place.text(), "the model's buffers are larger than 1 GiB",
                             "split the model");
        left -= size;
        buffers.emplace_back();
        buffers.back().data = bytes_of_buffer(file, entry, buffers.size() == 1, size);
    }
    return buffers;
}

/// tinygltf refuses a primitive whose indices are all 0 or sparse (an accessor without a view), which glTF
/// allows: the indices are handed over as one more attribute.
void make_indices_an_attribute(Value& primitive) {
    Value const* const indices = primitive.find("indices");
    if (!indices)
        return;
    auto& attributes = std::get<Table>(primitive.find("attributes")->data);
    attributes.emplace_back(gltf_indices_attribute, *indices);
    auto& table = std::get<Table>(primitive.data);
    table.erase(
        std::find_if(table.begin(), table.end(), [](auto const& entry) { return entry.first == "indices"; }));
}

bool is_accessor_type(std::string const& type) {
    constexpr std::array<std::string_view, 7> known = {"SCALAR", "VEC2", "VEC3", "VEC4",
                                                       "MAT2",   "MAT3", "MAT4"};
    return std::find(known.begin(), known.end(), type) != known.end();
}

/// The part of the tree that says where triangles are.
Value structure_of(Value const& tree) {
    constexpr std::array<std::string_view, 7> kept = {"asset",  "scene",     "scenes",     "nodes",
                                                      "meshes", "accessors", "bufferViews"};
    Table table;
    for (auto const& entry : std::get<Table>(tree.data))
        if (std::find(kept.begin(), kept.end(), entry.first) != kept.end())
            table.push_back(entry);
    Value structure{std::move(table), tree.place};
    if (Value* const accessors = structure.find("accessors"))
        for (Value& accessor : std::get<Array>(accessors->data))
            if (auto& type = std::get<std::string>(accessor.find("type")->data); !is_accessor_type(type))
                type = "MAT4"; // what no mesh can use: an unknown type is refused where a mesh does
    if (Value* const meshes = structure.find("meshes"))
        for (Value& mesh : std::get<Array>(meshes->data))
            for (Value& primitive : std::get<Array>(mesh.find("primitives")->data))
                make_indices_an_attribute(primitive);
    return structure;
}

bool no_file(std::string const&, void*) {
    return false;
}
std::string same_path(std::string const& path, void*) {
    return path;
}
bool read_nothing(std::vector<unsigned char>*, std::string*, std::string const&, void*) {
    return false;
}
bool write_nothing(std::string*, std::string const&, std::vector<unsigned char> const&, void*) {
    return false;
}

} // namespace

fs::path file_of_uri(std::string const& uri, fs::path const& folder, std::string const& place) {
    std::string const remedy = "put the file beside the model and name it as in \"data.bin\"";
    std::string const text = percent_decoded(uri);
    bool bad = text.empty() || text.front() == '/' ||
               text.find_first_of(std::string(":\\\0", 3)) != std::string::npos;
    for (fs::path const& part : fs::path(text))
        bad = bad || part.empty() || part == "." || part == "..";
    if (bad)
        throw InputError(place, "\"" + uri.substr(0, 80) + "\" is no path to a file in the model's folder",
                         remedy);
    std::error_code error;
    fs::path const home = fs::canonical(folder, error);
    fs::path const found = error ? fs::path() : fs::canonical(folder / text, error);
    if (error)
        throw InputError(place, "there is no file \"" + text + "\" in the model's folder", remedy);
    if (std::mismatch(home.begin(), home.end(), found.begin(), found.end()).first != home.end())
        throw InputError(place, "\"" + text + "\" leads out of the model's folder", remedy);
    return found;
}

std::vector<unsigned char> decoded_data_uri(std::string const& uri, std::string const& place) {
    std::vector<unsigned char> bytes;
    std::string mime_type;
    if (!tinygltf::IsDataURI(uri))
        throw InputError(place, "a data URI of this kind cannot be read",
                         "write data:application/octet-stream;base64,… or export as .glb");
    if (!tinygltf::DecodeDataURI(&bytes, mime_type, uri, 0, false))
        throw InputError(place, "its base64 data cannot be read", "export the file again");
    return bytes;
}

tinygltf::Model load_gltf(GltfFile const& file, Value const& tree) {
    std::string const text = to_json(structure_of(tree));
    tinygltf::TinyGLTF reader;
    reader.SetFsCallbacks({&no_file, &same_path, &read_nothing, &write_nothing, nullptr});
    tinygltf::Model model;
    std::string problem, warning;
    bool good = false;
    try {
        good = reader.LoadASCIIFromString(&model, &problem, &warning, text.data(),
                                          static_cast<unsigned>(text.size()), "");
    } catch (std::exception const& thrown) {
        problem = thrown.what();
    }
    if (!good) {
        std::replace(problem.begin(), problem.end(), '\n', ' ');
        throw InputError(file.name(), "not valid glTF: " + problem.substr(0, 200),
                         "check it with the glTF validator");
    }
    model.buffers = buffers_of(file, tree);
    return model;
}

} // namespace sahl

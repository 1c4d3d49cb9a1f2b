// In: triangles, and the JSON of materials and nodes. Out: the text of a glTF file with its data inside, in a
// folder that is gone when the test is.
#pragma once

#include "geometry/mesh.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace sahl::bench {

struct TemporaryFolder {
    std::filesystem::path path;

    explicit TemporaryFolder(std::string const& name)
        : path(std::filesystem::temp_directory_path() / ("sahl_" + name + "_" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(path);
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path); }
    TemporaryFolder(TemporaryFolder const&) = delete;
    TemporaryFolder& operator=(TemporaryFolder const&) = delete;

    std::filesystem::path write(std::string const& name, std::string const& text) const {
        std::ofstream(path / name, std::ios::binary) << text;
        return path / name;
    }
};

inline std::string base64(std::vector<unsigned char> bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::size_t const size = bytes.size();
    bytes.resize((size + 2) / 3 * 3);
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned const three =
            static_cast<unsigned>(bytes[i]) << 16 | static_cast<unsigned>(bytes[i + 1]) << 8 | bytes[i + 2];
        for (int shift : {18, 12, 6, 0})
            text += digits[three >> shift & 63u];
    }
    for (std::size_t i = 0; i < bytes.size() - size; ++i)
        text[text.size() - 1 - i] = '=';
    return text;
}

/// One mesh per soup, of one primitive whose material has the mesh's number (see `materials`, a JSON array).
///   nodes   a JSON array; empty: one node for each mesh, called "part0", "part1", …
///   more    further entries of the file, each with a comma before it
inline std::string gltf_text(std::vector<TriangleSoup> const& soups, std::string const& materials,
                             std::string nodes = "", std::string const& more = "") {
    std::vector<unsigned char> bytes;
    std::string views, accessors, meshes, all_nodes, roots;
    auto const append = [&](auto number) {
        unsigned char raw[sizeof number];
        std::memcpy(raw, &number, sizeof number);
        bytes.insert(bytes.end(), raw, raw + sizeof number);
    };
    auto const end_view = [&](std::size_t begin) {
        views += (views.empty() ? "" : ", ") + std::string(R"({"buffer": 0, "byteOffset": )") +
                 std::to_string(begin) + R"(, "byteLength": )" + std::to_string(bytes.size() - begin) + "}";
    };
    for (std::size_t i = 0; i < soups.size(); ++i) {
        std::string const comma = i == 0 ? "" : ", ", number = std::to_string(i);
        std::size_t begin = bytes.size();
        for (dvec3 const& p : soups[i].positions)
            for (int axis = 0; axis < 3; ++axis)
                append(static_cast<float>(p[axis]));
        end_view(begin);
        begin = bytes.size();
        for (auto const& triangle : soups[i].triangles)
            for (std::uint32_t const corner : triangle)
                append(corner);
        end_view(begin);
        accessors += comma + R"({"bufferView": )" + std::to_string(2 * i) +
                     R"(, "componentType": 5126, "type": "VEC3", "count": )" +
                     std::to_string(soups[i].positions.size()) + R"(}, {"bufferView": )" +
                     std::to_string(2 * i + 1) + R"(, "componentType": 5125, "type": "SCALAR", "count": )" +
                     std::to_string(3 * soups[i].triangles.size()) + "}";
        meshes += comma + R"({"name": "mesh)" + number + R"(", "primitives": [{"attributes": {"POSITION": )" +
                  std::to_string(2 * i) + R"(}, "indices": )" + std::to_string(2 * i + 1) +
                  R"(, "material": )" + number + "}]}";
        all_nodes += comma + R"({"name": "part)" + number + R"(", "mesh": )" + number + "}";
    }
    if (nodes.empty())
        nodes = "[" + all_nodes + "]";
    return R"({"asset": {"version": "2.0"}, "nodes": )" + nodes + R"(, "meshes": [)" + meshes +
           R"(], "materials": )" + materials + R"(, "buffers": [{"byteLength": )" +
           std::to_string(bytes.size()) + R"(, "uri": "data:application/octet-stream;base64,)" +
           base64(bytes) + R"("}], "bufferViews": [)" + views + R"(], "accessors": [)" + accessors + "]" +
           more + "}";
}

} // namespace sahl::bench

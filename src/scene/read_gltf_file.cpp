// In: a path. Out: the file's bytes, and where in them the JSON and the binary chunk are.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <system_error>

namespace sahl {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t json_budget = 256u << 20; // bytes: parsing takes several times as much memory

// "JSON" and "BIN\0", the types of chunks (glTF 2.0, section 4.4.3)
constexpr std::uint32_t json_chunk = 0x4E4F534A, bin_chunk = 0x004E4942;

std::uint32_t little_endian(std::vector<unsigned char> const& bytes, std::uint64_t at) {
    return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 |
           static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

/// 12 bytes of header, a JSON chunk, perhaps a BIN chunk; each chunk has 8 bytes of header (section 4.4
/// there).
void find_chunks(GltfFile& file) {
    auto const damaged = [&](std::string const& problem) {
        return InputError(file.name(), problem, "copy or export the file again");
    };
    std::uint64_t const size = file.bytes.size();
    if (size < 20)
        throw damaged("a .glb file of " + std::to_string(size) + " bytes is cut short");
    if (std::uint32_t const version = little_endian(file.bytes, 4); version != 2)
        throw InputError(file.name(), "this is version " + std::to_string(version) + " of binary glTF",
                         "export as glTF 2.0");
    std::uint64_t const length = little_endian(file.bytes, 8);
    if (length > size)
        throw damaged("its header says " + std::to_string(length) + " bytes, but it has " +
                      std::to_string(size));
    std::uint64_t const json_size = little_endian(file.bytes, 12);
    if (little_endian(file.bytes, 16) != json_chunk || json_size == 0 || 20 + json_size > length)
        throw damaged("its first chunk is not JSON, or reaches past the end");
    file.json_begin = 20;
    file.json_size = json_size;
    // a BIN chunk comes second, and chunks of other types may follow; chunks end at multiples of 4 bytes
    std::uint64_t begin = 20 + json_size;
    if (begin % 4 != 0)
        file.faults.push_back("a chunk does not end at a multiple of 4 bytes");
    for (int number = 1; begin + 8 <= length; ++number) {
        std::uint64_t const bytes = little_endian(file.bytes, begin);
        std::uint32_t const type = little_endian(file.bytes, begin + 4);
        if (begin + 8 + bytes > length)
            throw damaged(type == bin_chunk ? "its BIN chunk reaches past the end"
                                            : "a chunk reaches past the end");
        if (number == 1 && type == bin_chunk) {
            file.bin_begin = begin + 8;
            file.bin_size = bytes;
        } else if (type == bin_chunk || type == json_chunk) {
            file.faults.push_back("there is more than one chunk of a kind: the first counts");
        }
        if (bytes % 4 != 0)
            file.faults.push_back("a chunk does not end at a multiple of 4 bytes");
        begin += 8 + bytes;
        if (number == 1000)
            break;
    }
    if (begin < length)
        file.faults.push_back("bytes follow its last chunk");
    if (length < size)
        file.faults.push_back("bytes follow the length that its header says");
}

} // namespace

std::vector<unsigned char> read_bytes(fs::path const& path, std::uint64_t wanted, std::string const& place) {
    std::error_code error;
    if (!fs::exists(path, error))
        throw InputError(place, "there is no such file", "check the path");
    if (!fs::is_regular_file(path, error))
        throw InputError(place, "this is not a regular file", "name a file");
    std::vector<unsigned char> bytes(std::min<std::uint64_t>(wanted, fs::file_size(path, error)));
    std::ifstream stream(path, std::ios::binary);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (error || !stream)
        throw InputError(place, "the file cannot be read", "check that you may read it");
    return bytes;
}

namespace {

/// A brace, blanks before it, or a byte order mark.
bool could_be_json(unsigned char first) {
    return first == '{' || std::isspace(first) != 0 || first == 0xEF;
}

} // namespace

GltfFile read_gltf_file(fs::path const& path) {
    GltfFile file;
    file.path = path;
    file.bytes = read_bytes(path, gltf_file_budget + 1, path.string());
    if (file.bytes.size() > gltf_file_budget)
        throw InputError(file.name(), "the file is larger than 1 GiB", "split the model");
    if (file.bytes.empty())
        throw InputError(file.name(), "the file is empty", "export it again");
    file.json_size = file.bytes.size();
    if (file.bytes.size() >= 4 &&
        std::string_view(reinterpret_cast<char const*>(file.bytes.data()), 4) == "glTF")
        find_chunks(file);
    else if (path.extension() == ".glb" && !could_be_json(file.bytes.front()))
        throw InputError(file.name(),
                         "this is no glTF: its first bytes are neither those of the binary form nor JSON",
                         "export it again as glTF 2.0");
    if (file.json_size > json_budget)
        throw InputError(file.name(), "its JSON is larger than 256 MiB",
                         "export as .glb: data then lie outside the JSON");
    return file;
}

} // namespace sahl

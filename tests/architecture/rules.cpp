// In: an include. Out: whether the house allows it.
#include "architecture/rules.h"

#include <algorithm>
#include <array>

namespace sahl {

namespace {

/// A room and those it stands directly on; it may include these and all that they stand on.
struct Room {
    std::string_view name;
    std::vector<std::string_view> stands_on;
};

std::array<Room, 13> const rooms{{{"math", {}},
                                  {"image", {"math"}},
                                  {"optics", {"math"}},
                                  {"materials", {"optics"}},
                                  {"geometry", {"math"}},
                                  {"scene", {"materials", "geometry", "image"}},
                                  {"trace", {"scene"}},
                                  {"record", {"trace"}},
                                  {"render", {"trace"}},
                                  {"report", {"record", "render"}},
                                  {"run", {"report"}},
                                  {"cli", {"run"}},
                                  {"python", {"run"}}}};

/// A library, how the paths of its headers begin, and how the paths of the files begin that may include them.
struct Library {
    std::string_view name;
    std::vector<std::string_view> headers;
    std::string_view door; // empty: any file
};

std::array<Library, 16> const libraries{{{"GLM", {"glm/"}, "math/vec.h"},
                                         {"OpenImageIO", {"OpenImageIO/"}, "image/image.cpp"},
                                         {"OpenMesh", {"OpenMesh/"}, "geometry/mesh"},
                                         {"Embree", {"embree3/", "embree4/"}, "geometry/embree/"},
                                         {"tinygltf", {"tiny_gltf"}, "scene/read_gltf"},
                                         {"tinyobjloader", {"tiny_obj_loader"}, "scene/read_obj"},
                                         {"toml++", {"toml++/"}, "scene/toml_door.cpp"},
                                         {"nlohmann-json", {"nlohmann/"}, "scene/json_door.cpp"},
                                         {"HDF5", {"hdf5", "H5"}, "record/hdf5_file"},
                                         {"ISA-L", {"isa-l"}, "record/log_compress.cpp"},
                                         {"TBB", {"tbb/", "oneapi/"}, "run/"},
                                         {"OpenSSL", {"openssl/"}, "run/sha256.cpp"},
                                         {"CLI11", {"CLI/"}, "cli/"},
                                         {"pybind11", {"pybind11/"}, "python/module.cpp"},
                                         {"POSIX", {"unistd.h", "fcntl.h", "sys/"}, ""},
                                         {"glibc", {"malloc.h"}, "cli/main.cpp"}}};

Room const* room_called(std::string_view name) {
    auto const found = std::ranges::find(rooms, name, &Room::name);
    return found == rooms.end() ? nullptr : &*found;
}

std::string_view first_folder(std::string_view path) {
    auto const slash = path.find('/');
    return slash == path.npos ? std::string_view() : path.substr(0, slash);
}

bool may_include(Room const& from, std::string_view to) {
    return from.name == to || std::ranges::any_of(from.stands_on, [&](std::string_view below) {
               return may_include(*room_called(below), to);
           });
}

Library const* library_of(std::string_view header) {
    auto const found = std::ranges::find_if(libraries, [&](Library const& library) {
        return std::ranges::any_of(library.headers,
                                   [&](std::string_view start) { return header.starts_with(start); });
    });
    return found == libraries.end() ? nullptr : &*found;
}

/// The standard library's headers have neither folder nor ending.
bool is_standard(std::string_view header) {
    return header.find_first_of("./") == header.npos;
}

std::string_view without_blanks(std::string_view text) {
    auto const start = text.find_first_not_of(" \t");
    return start == text.npos ? std::string_view() : text.substr(start);
}

} // namespace

std::vector<Include> includes_of(std::string const& file, std::string_view text) {
    std::vector<Include> includes;
    for (int line = 1; !text.empty(); ++line) {
        std::string_view rest = without_blanks(text.substr(0, text.find('\n')));
        text.remove_prefix(
            std::min(text.size(), text.find('\n') == text.npos ? text.size() : text.find('\n') + 1));
        if (!rest.starts_with('#'))
            continue;
        rest = without_blanks(rest.substr(1));
        if (!rest.starts_with("include"))
            continue;
        rest = without_blanks(rest.substr(std::string_view("include").size()));
        if (rest.empty() || (rest[0] != '"' && rest[0] != '<'))
            continue;
        bool const quoted = rest[0] == '"';
        rest.remove_prefix(1);
        includes.push_back({file, line, std::string(rest.substr(0, rest.find(quoted ? '"' : '>'))), quoted});
    }
    return includes;
}

std::string problem_with(Include const& include) {
    std::string const place =
        "src/" + include.file + ":" + std::to_string(include.line) + ": " + include.path + ": ";
    Room const* const from = room_called(first_folder(include.file));
    if (!from)
        return place + "the file stands in no room; see the table of rooms in tests/architecture/rules.cpp";
    if (Room const* const to = room_called(first_folder(include.path)))
        return may_include(*from, to->name)
                   ? ""
                   : place + std::string(from->name) + " does not stand on " + std::string(to->name);
    if (include.quoted)
        return place + "paths in quotes begin with a room, relative to src/";
    if (is_standard(include.path))
        return "";
    Library const* const library = library_of(include.path);
    if (!library)
        return place + "this library has no door yet; name one in tests/architecture/rules.cpp";
    if (!include.file.starts_with(library->door))
        return place + "the door to " + std::string(library->name) + " is src/" + std::string(library->door);
    return "";
}

} // namespace sahl

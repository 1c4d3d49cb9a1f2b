// In: a path. Out: a Model, by the reader that its ending asks for.
#include "scene/read_model.h"

#include "math/input_error.h"
#include "scene/read_gltf.h"
#include "scene/read_obj.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace sahl {

namespace {

std::string lower_ending(std::filesystem::path const& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

} // namespace

bool is_model_file(std::filesystem::path const& path) {
    std::string const ending = lower_ending(path);
    return ending == ".gltf" || ending == ".glb" || ending == ".obj";
}

bool is_foreign_model_file(std::filesystem::path const& path) {
    constexpr std::array<std::string_view, 16> endings{".stl", ".ply",  ".fbx", ".dae",  ".3ds", ".3mf",
                                                       ".off", ".x3d",  ".stp", ".step", ".igs", ".iges",
                                                       ".usd", ".usdz", ".abc", ".blend"};
    return std::find(endings.begin(), endings.end(), lower_ending(path)) != endings.end();
}

Model read_model(std::filesystem::path const& path) {
    std::string const ending = lower_ending(path);
    if (ending == ".gltf" || ending == ".glb")
        return read_gltf(path);
    if (ending == ".obj")
        return read_obj(path);
    throw InputError(path.string(), "this is no model that can be read", "give a .gltf, .glb or .obj file");
}

} // namespace sahl

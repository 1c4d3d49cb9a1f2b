// In: an OBJ file, step by step: its lines, its materials. Out: the parts of a Model.
// Shared by read_obj*.cpp alone.
#pragma once

#include "scene/model.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sahl {

constexpr std::uint32_t obj_none = 0xFFFFFFFFu;

/// Polygons in a row that belong to the same object, group and material.
struct ObjRun {
    std::uint32_t first_polygon = 0;
    std::uint32_t object = obj_none, group = obj_none, material = obj_none;
};

/// What the lines of an OBJ file say, indices resolved and in range.
struct ObjText {
    std::vector<dvec3> positions, normals;
    std::vector<std::uint32_t> corners;        // of all polygons in a row; into positions
    std::vector<std::uint32_t> corner_normals; // the same, or obj_none; empty: no polygon has normals
    std::vector<dvec2> texture_coordinates;
    std::vector<std::uint32_t> corner_textures; // into these, or obj_none; empty: no polygon has any
    std::vector<std::uint32_t> polygons;        // where each begins in corners, and where the last ends
    std::vector<ObjRun> runs;
    std::vector<std::string> objects, groups, materials; // names, as the lines give them
    struct Library {
        std::string names; // one or several, separated by blanks
        std::string place;
    };
    std::vector<Library> libraries;
    std::vector<std::string> material_places; // where each is first asked for
};

ObjText parse_obj(std::string_view text, std::string const& file, std::vector<std::string>& warnings);

/// The materials that the file names, in the order of ObjText::materials; those that no library has are
/// opaque, with a warning.
std::vector<ModelMaterial> obj_materials(std::filesystem::path const& path, ObjText const& text,
                                         std::vector<std::string>& warnings);

/// The meshes, and an instance of each.
void add_obj_meshes(Model& model, ObjText const& text, std::string const& file);

} // namespace sahl

// In: a model as plain data, and lines beside it. Out: a glTF 2.0 file (.glb) that read_gltf reads as the
// same.
#pragma once

#include "scene/model.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sahl {

/// Straight pieces, from each even place to the next, each place with a colour (linear RGB and coverage, 255
/// = 1). They stand in the world, in metres.
struct ModelLines {
    std::string name;
    std::vector<dvec3> places;
    std::vector<std::array<std::uint8_t, 4>> colours; // as many
    std::string extras{};                             // JSON, or empty
};

/// Places and normals become floats, transforms stay double. A face of a mesh is a primitive; faces without
/// triangles are left out. Transforms must be made of a scale along the mesh's axes, a turn and a move (see
/// is_made_of_scale_and_turn). `out` appears when it is complete. Throws InputError where it cannot be
/// written, or would be larger than the format can say, 4 GiB.
void write_glb(Model const& model, std::span<ModelLines const> lines, std::filesystem::path const& out);

/// Whether glTF has a word for it: its columns are at right angles, to rounding.
bool is_made_of_scale_and_turn(dmat3 const& linear);

} // namespace sahl

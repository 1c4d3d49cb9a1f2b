// In: the tables [surface.NAME] and names asked for. Out: surfaces, by id.
#pragma once

#include "materials/surface.h"
#include "math/ids.h"
#include "scene/value.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace sahl {

/// All surfaces of `definitions` (the table `surface`, or nullptr) in the order of the file.
/// folder   that of the experiment's file, for textures
std::vector<Surface> read_surfaces(Value const* definitions, std::filesystem::path const& folder);

/// The surface of that name. Throws InputError with the nearest name, or how to define it.
SurfaceId find_surface(std::vector<Surface> const& surfaces, std::string_view name, Place const& place);

} // namespace sahl

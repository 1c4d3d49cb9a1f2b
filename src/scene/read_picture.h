// In: the tables [camera], [[light]], [background] and [picture]. Out: what a picture needs beside the scene.
#pragma once

#include "scene/picture.h"

#include <filesystem>

namespace sahl {

/// folder   that of the experiment's file
/// A table that is absent has its defaults; without [camera] there is none. Throws InputError.
Picture read_picture(Value const& tree, std::filesystem::path const& folder);

} // namespace sahl

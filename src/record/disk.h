// In: files and folders. Out: the same on the disk, for good.
#pragma once

#include "math/input_error.h"

#include <filesystem>
#include <string>

namespace sahl {

/// Everything of this file or folder is on the disk when it returns; what hinders it is an InputError.
void sync_to_disk(std::filesystem::path const& path, std::string const& remedy);

/// Gives a file or folder, which is on the disk, another name for good; what had that name is replaced.
void move_on_disk(std::filesystem::path const& from, std::filesystem::path const& to,
                  std::string const& remedy);

} // namespace sahl

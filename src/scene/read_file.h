// In: paths. Out: files that are there, and their bytes.
#pragma once

#include "scene/value.h"

#include <filesystem>
#include <string>

namespace sahl {

/// The path of a file named in the experiment, relative to `folder`. Throws InputError, with the nearest name
/// beside it, where there is none.
std::filesystem::path existing_file(std::filesystem::path const& folder, std::string const& name,
                                    Place const& place);

/// All bytes of a file. Throws InputError where it cannot be read or has more than 1 GiB.
std::string file_text(std::filesystem::path const& path);

} // namespace sahl

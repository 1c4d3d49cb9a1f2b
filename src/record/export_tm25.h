// In: a ray log. Out: the rays that arrived at one detector or face, as an IES TM-25 ray file.
#pragma once

#include "record/ray_log.h"
#include "trace/path_filter.h"

#include <filesystem>
#include <string>

namespace sahl {

/// Place (mm, world), direction and radiant flux (W) of every ray where it arrives, rounded to float as the
/// format has them; its wavelength (nm) beside them, unless all have the same. Of a detector these are the
/// rays that it counts, of any other face all that arrive.
///   where   its name in the log; empty: the only detector that light came to
///   paths   only light that came by paths that it selects; or null
/// Throws InputError: no such name, no light there, a log that was thinned, a file that cannot be written.
void export_tm25(RayLogReader const& log, std::string const& where, std::filesystem::path const& out,
                 PathFilter const* paths = nullptr);

} // namespace sahl

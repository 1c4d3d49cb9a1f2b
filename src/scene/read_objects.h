// In: the tables [[object]]. Out: bodies and open surfaces, with every name resolved.
#pragma once

#include "scene/experiment.h"
#include "scene/read_media.h"
#include "scene/read_transform.h"

#include <filesystem>
#include <vector>

namespace sahl {

/// folder   that of the experiment's file
/// Throws InputError. Names are not compared with one another here.
std::vector<ObjectSpec> read_objects(Array const& tables, MediaBook& media,
                                     std::vector<Surface> const& surfaces, Groups const& groups,
                                     std::filesystem::path const& folder);

} // namespace sahl

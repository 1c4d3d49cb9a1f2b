// In: a model file and the scene that is built of it. Out: where its meshes are not as they should be, for a
// page.
#pragma once

#include "report/page.h"

#include <filesystem>
#include <vector>

namespace sahl {

/// Borders of what should be closed or ends, triangles that were turned round, thin ones, edges that more
/// than two triangles share. Of each kind that there is one mark; of each the first 20 000 pieces.
std::vector<PageMark> model_marks(std::filesystem::path const& file, Scene const& scene);

} // namespace sahl

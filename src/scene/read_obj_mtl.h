// In: MTL files. Out: what their lines say of each material, and what in them cannot be read.
// Shared by read_obj*.cpp alone.
#pragma once

#include "scene/model.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace sahl {

/// A value that cannot be read.
struct MtlFault {
    std::string key, place, problem, remedy;
};

/// Absent: the file says nothing of it. Names as in the file.
struct MtlMaterial {
    std::string name, place;
    std::optional<double> ni, d, tr, pm;             // d, tr, pm: [0, 1]
    std::optional<int> illum;                        // [0, 10]
    std::optional<std::array<double, 3>> kd, ks, tf; // ≥ 0
    std::string ni_text, ni_place;
    std::optional<ModelTexture> map_kd;
    std::vector<std::string> left_out; // a sentence each
    std::vector<MtlFault> faults;
};

struct MtlLibrary {
    std::vector<MtlMaterial> materials;
    std::unordered_map<std::string, std::size_t> numbers; // by name
    std::uintmax_t bytes = 0;                             // read so far
};

/// Adds the materials of the files that `names` gives: one name, blanks and all, or several. They must lie in
/// `folder`, links followed, or are not opened. What cannot be read is warned of, with `place`.
void add_mtl_files(std::filesystem::path const& folder, std::string const& names, std::string const& place,
                   MtlLibrary& library, std::vector<std::string>& warnings);

} // namespace sahl

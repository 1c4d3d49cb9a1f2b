// In: faults of a glTF file that cannot change the light, as they are found. Out: warnings, not too many.
// Shared by read_gltf_faults.cpp and read_gltf_extensions.cpp alone.
#pragma once

#include "math/input_error.h"
#include "scene/read_gltf_parts.h"

namespace sahl {

struct GltfFaults {
    static constexpr std::size_t most = 100; // a file of a million is not told of each
    std::vector<std::string>& warnings;
    std::size_t told = 0;

    void add(Place const& place, std::string const& problem) {
        if (++told <= most)
            warnings.push_back(place.text() + ": " + problem);
    }
};

/// The array under that key; empty where there is none.
inline Array const& gltf_entries(Value const& tree, std::string_view key) {
    static Array const none;
    Value const* const list = tree.find(key);
    auto const* const array = list ? std::get_if<Array>(&list->data) : nullptr;
    return array ? *array : none;
}

/// Extensions that are no objects, that nothing declares, or that stand where they mean nothing.
void check_gltf_extensions(Value const& tree, GltfFaults& faults);

} // namespace sahl

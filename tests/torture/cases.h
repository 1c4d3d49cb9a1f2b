// In: the number of a variant. Out: the torture suite: touching, nested, grazing, thin, far, endless.
#pragma once

#include "torture/scene.h"

#include <vector>

namespace sahl::bench {

/// Variant 0 has round numbers; each other one has radii, triangulations, angles and places of its own.
std::vector<TortureCase> torture_cases(std::uint64_t variant);

// what it consists of, by what they are about
void add_edge_cases(std::vector<TortureCase>& cases, std::uint64_t variant);    // edges, corners, fans, grids
void add_grazing_cases(std::vector<TortureCase>& cases, std::uint64_t variant); // grazing, critical, normal
void add_contact_cases(std::vector<TortureCase>& cases,
                       std::uint64_t variant); // touching, nested, overlapping
void add_endless_cases(std::vector<TortureCase>& cases,
                       std::uint64_t variant); // pipes, galleries, corner cubes
void add_extreme_cases(std::vector<TortureCase>& cases,
                       std::uint64_t variant); // thin, far, of all scales, born there
void add_mixed_cases(std::vector<TortureCase>& cases,
                     std::uint64_t variant); // meshes and exact shapes in one scene
void add_combined_cases(std::vector<TortureCase>& cases,
                        std::uint64_t variant); // all that there is in one scene

} // namespace sahl::bench

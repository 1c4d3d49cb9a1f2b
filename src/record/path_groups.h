// In: a ray log. Out: its paths, grouped by the surfaces they met and what happened there.
#pragma once

#include "record/ray_log.h"
#include "trace/path_filter.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sahl {

/// Paths of the same events at the same surfaces, in this order.
struct PathGroup {
    struct Step {
        Event event;
        std::int32_t surface; // −1: nothing
        std::uint32_t times;  // one after another
    };
    std::vector<Step> steps{};
    std::uint64_t paths = 0, rays = 0; // ends of trees; rays that have at least one of them
    double power = 0.0;                // W, at the paths' ends
    double mean_optical_path = 0.0;    // m, weighed by power; of light that escapes to its last surface
    std::string filter{};              // selects these and no others
};

struct PathGroups {
    std::uint64_t rays = 0, segments = 0, paths = 0; // in the log; paths: that are selected
    double began = 0.0;                              // W, of all rays in the log
    double power = 0.0;                              // W, at the ends of all selected paths
    std::vector<PathGroup> groups{};                 // of greatest power first
    PathGroup other{};                               // what is in none of them, summed up
    double surely_above = 0.0;                       // W: no group of more power was overlooked; 0: none was
};

/// Groups whose power is at least this share of that of all rays in the log. Memory does not grow with the
/// log, nor with the number of different paths: of these the weakest are given up where there are too many
/// (Misra and Gries 1982), and the log is then read twice, so that figures are exact.
///   where       only the paths that it selects; or null
///   least_share [0, 1]
///   room        different paths that are remembered at once; rises to 4 / least_share, at most to 2²⁰
PathGroups group_paths(RayLogReader const& log, PathFilter const* where, double least_share,
                       std::size_t room = std::size_t{1} << 16);

/// "path(2 refracted(lens.front), escaped)"
std::string filter_of(std::vector<PathGroup::Step> const& steps, std::vector<std::string> const& surfaces);

} // namespace sahl

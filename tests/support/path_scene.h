// In: nothing. Out: a small scene in which nearly everything happens to light, as an experiment's text, and
// its paths, each written out from its source to its end.
#pragma once

#include "record/log_columns.h"
#include "support/bench.h"

#include <map>

namespace sahl::bench {

/// A lens, a ball of coloured glass, a mirror, a half mirror, a white and a black wall, a window that counts
/// light and a screen that stops it; three sources, three wavelengths.
inline char const* const path_scene = R"(
trace = {min_power = 1e-3, max_depth = 9, log = true}
medium = {tinted = {n = 1.6, absorption_per_mm = 0.02}}
surface = {silver = {metal = "silver"}, half = {reflect = 0.4, transmit = 0.5}, wall = {absorb = true}, white = {diffuse = 0.9}}
[[object]]
name = "lens"
shape = {lens = {r1_mm = 30, r2_mm = -30, thickness_mm = 4, diameter_mm = 16}}
medium = "N-BK7"
[[object]]
name = "ball"
shape = {sphere = {radius_mm = 5}}
medium = "tinted"
move_mm = [0, 1, 20]
[[object]]
name = "block"
shape = {box = {size_mm = [6, 6, 6]}}
medium = "N-SF11"
turn_deg = [20, 30, 0]
move_mm = [-9, 0, 12]
faces = {left = "silver"}
[[object]]
name = "splitter"
shape = {rectangle = {size_mm = [14, 14]}}
surface = "half"
turn_deg = [0, 4, 0]
move_mm = [0, 0, 32]
[[object]]
name = "paper"
shape = {rectangle = {size_mm = [30, 30]}}
surface = "white"
turn_deg = [0, 90, 0]
move_mm = [25, 0, 25]
[[object]]
name = "black"
shape = {rectangle = {size_mm = [30, 30]}}
surface = "wall"
turn_deg = [0, 90, 0]
move_mm = [-25, 0, 25]
[[source]]
name = "beam"
beam = {from_mm = [0, 0, -10], toward = [0, 0, 1], radius_mm = 6, pattern = "hexagonal", rays = 60}
lines = ["F", "d", "C"]
[[source]]
name = "lamp"
power_W = 0.5
point = {at_mm = [-20, 3, 12], toward = [1, -0.1, 0], half_angle_deg = 12, rays = 60}
wavelengths_nm = [587.5618]
[[source]]
name = "stray"
power_W = 0.1
rays = [[0, 60, 0, 0, 0, 1], [0, 0, 60, 0, 0, -1], [2, 1, 60, 0, 0, -1]]
wavelengths_nm = [587.5618]
[[detector]]
name = "window"
at_mm = [0, 0, 10]
facing = [0, 0, -1]
size_mm = [20, 20]
absorbs = false
back = true
[[detector]]
name = "screen"
at_mm = [0, 0, 45]
facing = [0, 0, -1]
size_mm = [40, 40]
)";

struct PathStep {
    std::string event, surface;
};

/// One end of one ray's tree, and all that led there.
struct WrittenPath {
    std::vector<PathStep> steps;
    std::vector<std::string> media;
    std::string source;
    double wavelength_nm = 0.0, power_W = 0.0, share = 0.0, optical_path_mm = 0.0;
    std::size_t depth = 0;
    std::uint64_t ray = 0;
    std::vector<std::uint32_t> segments; // their numbers, the last first
};

/// Slow and plain: up from every segment that is nobody's parent.
inline std::vector<WrittenPath> paths_of(LogHeader const& names, std::vector<Segment> const& rows) {
    std::map<std::pair<std::uint64_t, std::int64_t>, Segment const*> by_number;
    std::map<std::pair<std::uint64_t, std::int64_t>, bool> is_parent;
    for (Segment const& s : rows) {
        by_number[{s.ray, s.index}] = &s;
        is_parent[{s.ray, s.parent}] = true;
    }
    auto const surface = [&](Segment const& s) {
        return s.surface < 0 ? std::string() : names.surfaces[static_cast<std::size_t>(s.surface)];
    };
    std::vector<WrittenPath> paths;
    for (Segment const& end : rows) {
        if (is_parent.count({end.ray, end.index}) != 0)
            continue;
        WrittenPath path;
        path.steps = {{std::string(name_of(end.ended)), surface(end)}};
        path.source = names.sources[end.source];
        path.wavelength_nm = in_nm(end.wavelength);
        path.power_W = end.power_end;
        path.optical_path_mm = in_mm(end.optical_path);
        path.depth = end.depth;
        path.ray = end.ray;
        for (Segment const* s = &end;;) {
            path.segments.push_back(s->index);
            path.media.insert(path.media.begin(), names.media[s->medium]);
            if (s->parent < 0) {
                path.share = path.power_W / s->power_start;
                break;
            }
            Segment const* const parent = by_number.at({s->ray, s->parent});
            path.steps.insert(path.steps.begin(), {std::string(name_of(s->born)), surface(*parent)});
            if (std::isinf(path.optical_path_mm))
                path.optical_path_mm = in_mm(parent->optical_path);
            s = parent;
        }
        if (std::isinf(path.optical_path_mm)) // it meets nothing at all
            path.optical_path_mm = 0.0;
        paths.push_back(std::move(path));
    }
    return paths;
}

} // namespace sahl::bench

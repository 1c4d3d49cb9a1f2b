// In: a mesh as make_mesh leaves it. Out: where its surface is smooth and where it folds, and at each corner
// of a triangle the normal that curved patches take there: the file's, where they say more than the positions
// do.
#pragma once

#include "geometry/mesh.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace sahl {

/// What curved patches make of a file's normals.
enum class NormalUse {
    files,      // they agree with the positions as well as the positions can tell
    none,       // the file has none
    flat,       // they are the triangles' own
    first_order // averages of neighbouring triangles, or of few digits: the positions alone tell more
};

/// Corners of triangles at one place that hang together without a crease. Of a cavity, all is turned round:
/// normals point out of the volume that the shell encloses.
struct Fan {
    dvec3 place{0.0};
    dvec3 normal{0.0};                           // unit
    std::uint32_t first_corner = 0, corners = 0; // in SmoothFans::corners
};

struct SmoothTriangle {
    static constexpr std::uint32_t none = 0xFFFFFFFFu;
    std::array<std::uint32_t, 3> fans{};                   // anticlockwise seen from outside
    std::array<std::uint32_t, 3> beside{none, none, none}; // the triangle across the side opposite each
                                                           // corner; none over a crease
    std::uint8_t creases = 0; // bit k: the side opposite corner k is a crease, a border, or cut by a
                              // vertex of the other side; the surface there is the chord
};

struct SmoothFans {
    std::shared_ptr<Mesh const> mesh;
    std::vector<SmoothTriangle> triangles;
    std::vector<Fan> fans;
    std::vector<std::uint32_t> corners; // triangles round each fan
    NormalUse normals = NormalUse::none;
    double normals_off = 0.0;    // rad, of the file's normals against the positions', median
    double positions_blur = 0.0; // rad, how far the positions' own normals can be trusted, median
    bool float_positions = true;
    double reach = 0.0;               // m, the largest coordinate: it tells the rounding of float positions
    std::vector<std::uint32_t> group; // of each triangle: smooth pieces between creases
    std::uint32_t groups = 0;
};

/// m: what float positions leave open of heights; in double a share of rounding.
double height_noise(SmoothFans const& fans);

SmoothFans smooth_fans(std::shared_ptr<Mesh const> mesh);

} // namespace sahl

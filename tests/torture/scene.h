// In: nothing. Out: a scene of the torture suite as plain data: bodies of clear media in their places, and
// rays.
#pragma once

#include "geometry/mesh.h"
#include "geometry/shape.h"
#include "math/ids.h"
#include "support/dice.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sahl::bench {

using MeshRef = std::shared_ptr<Mesh const>;

/// Where two bodies overlap the one of higher priority is there, of equals the later one.
struct TorturePart {
    std::variant<Shape, MeshRef> geometry;
    std::uint32_t medium = 1;
    Affine place{};
    int priority = 0;
    bool mirror = false; // an open surface that reflects all: a rectangle, a disk or a mesh; it has no medium
    bool torn = false;   // a mesh with holes: what is met that does not fit is a leak, as it should be
};

struct TortureRay {
    dvec3 origin, direction;
    std::optional<std::uint32_t> part = {}; // it is born on this part's surface,
    std::uint32_t face = 0;                 // on this face or triangle
};

/// How a path goes on where a boundary sends light both ways. Where nothing can be refracted all reflect.
enum class Rule { straight, transmit, reflect, either };

struct TortureCase {
    std::string name, of;        // "exact", "mesh" or "mixed"
    std::vector<double> indices; // by medium; the first is that of the surroundings
    std::vector<TorturePart> parts;
    std::function<TortureRay(Dice&, std::uint64_t)> ray;
    Rule rule = Rule::either;
    std::uint32_t events = 8; // that a path is followed for
    double contact = 0.0;     // m: faces of different parts that lie no farther apart were placed to touch
    bool faces = true;        // the faces that are met must agree too, not only the media
    double share = 1.0; // of the rays that a run asks for: a path of ten thousand events stands for many
};

/// Which way the path goes at its event number `event`: drawn by ray and event, for every method alike.
inline bool goes_through(Rule rule, std::uint64_t ray, std::uint32_t event) {
    if (rule != Rule::either)
        return rule != Rule::reflect;
    std::uint64_t x = (ray * 0x9E3779B97F4A7C15u) ^ ((event + 1) * 0xD1B54A32D192ED03u);
    x ^= x >> 32;
    x *= 0xD6E8FEB86659FD93u;
    return (x >> 40) % 4 != 0 || event == 0; // three times out of four
}

} // namespace sahl::bench

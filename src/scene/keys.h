// In: nothing. Out: every key an experiment file may hold: its name (the unit is in it), type, range,
// default, meaning. Two read these tables: the readers (scene/read_table.h) and the page docs/experiment.md
// (keys_reference).
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace sahl {

enum class Kind {
    truth,   // true or false
    integer, // 1e6 is one too
    number,  // finite
    text,
    numbers, // a list of finite numbers, of any length
    two,     // and of exactly this many
    three,
    four,
    sixteen,
    pairs, // a list of [number, number]
    texts, // a list of text
    table,
    tables, // [[…]]
    any     // its reader says what it takes
};

struct Required {};
/// [value, value, …]
struct Repeated {
    int count;
    double value;
};
/// What holds where the key is absent; monostate: nothing, the meaning says what then.
using Default = std::variant<std::monostate, Required, bool, double, std::string_view, Repeated>;

/// Bounds of a number, or of each number of a list; both belong to the range unless `above`, which takes
/// `low` out.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool above = false;
};

struct Key {
    std::string_view name;
    Kind kind;
    Default fallback;
    std::string_view meaning;
    Range range{};
};

struct KeyTable {
    std::string_view title; // as it stands in messages: "shape sphere"
    std::string_view about; // a sentence for the reference
    std::span<Key const> keys;
};

namespace keys {
// keys.cpp
extern KeyTable const experiment, trace, log, limits, group, sweep, sweep_range, goal, goal_range;
// keys_picture.cpp
extern KeyTable const camera, light, light_point, light_spot, light_directional, background, picture,
    caustics;
// keys_materials.cpp
extern KeyTable const medium, sellmeier, cauchy, surface, paint, checker;
// keys_objects.cpp
extern KeyTable const object, material, shape, sphere, box, cylinder, lens, prism, plane, rectangle, disk,
    cone, corner_cube, quadric, conic_mirror;
// keys_light.cpp
extern KeyTable const source, beam, profile, point, lambertian, spectrum, polarisation, detector, far_field;
} // namespace keys

/// All of them, in the order of the reference.
std::span<KeyTable const* const> key_tables();

/// "a number above 0": what may stand under a key.
std::string expected(Key const& key);

/// The tables as Markdown, one section each.
std::string keys_reference();

} // namespace sahl

// In: nothing. Out: the events that begin and end a segment, with the codes they have in logs.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace sahl {

/// Codes are part of the log format: they are only ever appended.
enum class Event : std::uint8_t {
    none = 0,
    emitted = 1,
    refracted = 2,
    reflected = 3,
    total_internal = 4,
    absorbed = 5,
    detected = 6,
    escaped = 7,
    cut_power = 8,
    cut_depth = 9,
    leak = 10,
    invalid = 11,
    passed = 12, // through a detector that does not absorb
    scattered = 13,
};

inline constexpr std::array<std::string_view, 14> event_names{
    "none",    "emitted",   "refracted", "reflected", "total_internal", "absorbed", "detected",
    "escaped", "cut_power", "cut_depth", "leak",      "invalid",        "passed",   "scattered"};

constexpr std::string_view name_of(Event event) {
    return event_names[static_cast<std::size_t>(event)];
}

} // namespace sahl

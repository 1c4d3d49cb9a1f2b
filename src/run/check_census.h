// In: a scene. Out: what a few pilot rays of each source meet, where each source starts, which bodies let
// light in: what a person would otherwise learn from a dark detector.
#pragma once

#include "trace/tracer.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sahl {

/// Where some rays of a source begin.
struct StartingPlace {
    std::optional<ObjectId> body; // none: the surroundings
    std::vector<ObjectId> on;     // on the surface of these
    std::uint64_t rays = 0;
};

struct PilotOfSource {
    std::uint64_t rays = 0, meet_something = 0;
    std::vector<StartingPlace> starts; // the most frequent first
};

struct PilotOfBody {
    bool reached = false;              // a pilot ray ends a segment on it
    bool entered = false;              // light was refracted at it, or a source starts in it
    bool opaque = false;               // no face lets light through
    std::optional<ObjectId> walled_in; // stands within this opaque body
};

struct PilotOfDetector {
    std::uint64_t hits = 0, hits_from_behind = 0;
};

struct Census {
    std::vector<PilotOfSource> sources;
    std::vector<PilotOfBody> bodies; // by ObjectId; those of detectors are never looked at
    std::vector<PilotOfDetector> detectors;
    std::uint64_t segments = 0, lost = 0;
    std::optional<dvec3> first_lost_at; // m
};

/// Does a surface let none through?
bool is_opaque(Surface const& surface);

Census take_census(Scene const& scene, WavelengthTable const& optics, Emission const& emission,
                   TraceOptions const& options);

} // namespace sahl

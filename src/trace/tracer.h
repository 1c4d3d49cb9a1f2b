// In: a scene and rays. Out: their trees of branches: what became of their power, what reached the detectors,
// and, if asked, every segment.
#pragma once

#include "scene/scene.h"
#include "trace/scene_filters.h"
#include "trace/segment.h"
#include "trace/sources.h"
#include "trace/spread.h"
#include "trace/tally.h"
#include "trace/tree_watch.h"
#include "trace/wavelengths.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sahl {

/// Light that met a detector on the side that counts.
struct DetectorHit {
    DetectorId detector;
    WavelengthId wavelength;
    SourceId source;
    std::uint64_t ray = 0;
    dvec2 at{0.0};             // m, from the detector's centre, along its x and y
    dvec3 direction{0.0};      // world
    double power = 0.0;        // W
    double optical_path = 0.0; // m
};

/// A ray that was lost, and where that showed: what it met there, or from there on, does not fit what it was
/// in.
struct LostRay {
    std::uint64_t ray = 0;
    Event event = Event::leak;
    dvec3 at{0.0};
    double power = 0.0;                // W
    dvec3 origin{0.0}, direction{0.0}; // of its last piece
};

/// What a batch of rays leaves behind.
struct BatchResult {
    Tally tally;
    std::vector<DetectorHit> hits; // by ray, then in the order of the tree
    std::vector<LostRay> lost;
    DigitsLost digits; // counted where the options ask for it
    SegmentBatch log;  // empty unless asked for, or where a sink took the segments
};

/// What tracing needs to know, all by reference; nothing is changed.
struct TraceContext {
    Scene const& scene;
    WavelengthTable const& optics;
    Emission const& emission;
    TraceOptions const& options;
    SumUnit unit;
    std::uint64_t log_every = 0;          // 0: no log; 1: every ray; n: each n-th
    double log_min_power = 0.0;           // share of the ray's power; what begins with less is not logged
    PathFilters const* filters = nullptr; // or none
    bool again = false;                   // the same rays with other draws, to see what is left to chance
    bool polarised = false;               // s and p kept apart
};

inline constexpr std::uint64_t rays_per_batch = 4096;

/// Rays [first, first + count). The result does not depend on how rays are grouped into calls.
/// sink   takes the segments that are logged, if given, as soon as their trees are complete
BatchResult trace_batch(TraceContext const& context, std::uint64_t first, std::uint64_t count,
                        SegmentSink* sink = nullptr);

/// The same for rays that no source emits, the first of them with the number `first`: nothing is counted but
/// the events that ended segments; a watch sees the trees. Scenes with detectors are not for this.
///   start   what all of them start in, where that is known
std::array<std::uint64_t, event_names.size()> trace_rays(TraceContext const& context, std::uint64_t first,
                                                         std::span<Ray const> rays, TreeWatch& watch,
                                                         Bvh::Start const* start = nullptr);

} // namespace sahl

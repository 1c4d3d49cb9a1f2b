// In: a scene and its options. Out: all of its rays traced, counted and recorded, on as many threads as are
// asked for. run/trace_scene.cpp is the door to TBB.
#pragma once

#include "record/detector.h"
#include "record/ray_log.h"
#include "run/holes.h"
#include "trace/tracer.h"

#include <atomic>
#include <functional>
#include <vector>

namespace sahl {

struct TraceOutcome {
    Tally tally;
    std::vector<DetectorRecord> detectors;
    std::vector<LostRay> lost; // the first few
    std::uint64_t rays = 0;
    bool whole = true; // not stopped on the way
    double seconds = 0.0;
    unsigned threads = 1;
    DigitsLost digits{};       // where the options ask for it
    std::vector<Hole> holes{}; // of meshes that are not closed, with the rays that leaked there
};

/// Called now and then from one thread with the number of rays done.
using Progress = std::function<void(std::uint64_t done, std::uint64_t total)>;

/// What is known of the rays that are done, now and then, to go on from; called from one thread.
struct KnownSoFar {
    std::optional<std::string> before; // what was kept when the run was stopped
    std::function<bool()> due;         // whether it is time to keep
    std::function<void(std::string const&)> keep;
};

/// Throws InputError where a path filter of the scene or the log is wrong.
/// The same result, bit for bit, for any number of threads (0: all there are), stopped and gone on with or
/// not.
///   log      where segments go, or nullptr; one that goes on where it was stopped brings what was known
///   then,
///            and only the rays after that are traced
///   logged   which of them do
///   known    where a run without a log keeps what it knows, and brings what was known; or nullptr
///   stop     once it is set, no batch is begun; what is known of those that were done is kept
TraceOutcome trace_scene(Scene const& scene, WavelengthTable const& optics, Emission const& emission,
                         TraceOptions const& options, unsigned threads, RayLogWriter* log,
                         LogOptions const& logged, Progress const& progress,
                         KnownSoFar const* known = nullptr, std::atomic<bool> const* stop = nullptr);

/// The unit in which the powers of this emission are summed.
SumUnit power_unit(Emission const& emission);

} // namespace sahl

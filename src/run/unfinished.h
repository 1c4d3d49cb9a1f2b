// In: what a run knows so far. Out: the same to the next start, if this one is killed: a folder inside that
// of the unfinished run, which is gone when the run is complete.
#pragma once

#include "run/trace_scene.h"
#include "scene/value.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace sahl {

/// Its name; nothing of it belongs to the results.
inline constexpr char const* unfinished_folder = "unfinished";

/// Keeps what is known of a run without a log, whose rays need not be traced again.
///   run      the folder of its results
///   resume   whether what a stopped run left there is taken up; else it is removed
///   seconds   from one time to the next, at least; keeping it takes no more than a twentieth of the time
KnownSoFar known_in(std::filesystem::path const& run, bool resume, double seconds);

/// The summary of a goal's run at one value of what it may vary, if an earlier start came to it.
std::optional<Value> kept_look(std::filesystem::path const& run, double at);
void keep_look(std::filesystem::path const& run, double at, Value const& summary);

} // namespace sahl

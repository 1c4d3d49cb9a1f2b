// In: a scene and a picture's options. Out: the film, on as many threads as are asked for.
#pragma once

#include "render/picture.h"
#include "run/trace_scene.h"

#include <atomic>

namespace sahl {

struct RenderOutcome {
    Film film;
    EventCounts ended{};      // segments by the event that ended them
    double cpu_seconds = 0.0; // the same, of all threads of the process
    double seconds = 0.0;     // of rendering alone
    unsigned threads = 1;
    bool whole = true;               // false: it was stopped
    std::uint64_t sampled_again = 0; // pixels that got all their samples because they differ from a neighbour
};

/// The same pixels, bit for bit, for any number of threads (0: all there are).
///   progress   is told samples: done, and of all
///   stop       once it is set, what is begun is finished, and that is all
RenderOutcome render_scene(PictureMaker const& maker, PictureOptions const& options, unsigned threads,
                           Progress const& progress, std::atomic<bool> const& stop);

} // namespace sahl

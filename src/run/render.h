// In: an experiment or a model. Out: its picture in files, and what it took.
#pragma once

#include "run/run.h"

#include <atomic>

namespace sahl {

struct RenderOptions {
    std::vector<std::filesystem::path> files; // .png, .exr; empty: nothing is written
    unsigned threads = 0;                     // 0: all there are
    Progress progress;
    std::atomic<bool> const* stop = nullptr; // once it is set, what is done is written, if pixels were begun
    ModelCache* models = nullptr;            // those of earlier runs; none: it reads its own
};

struct RenderResult {
    Value summary;
    bool whole = true;
    bool begun = true; // false: it was stopped before the first pixel, and nothing is written
};

/// Renders the experiment's picture. Throws InputError, and then nothing is written.
RenderResult render_experiment(ExperimentSource const& source, RenderOptions const& options);

} // namespace sahl

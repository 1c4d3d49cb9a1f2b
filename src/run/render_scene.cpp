#include "run/render_scene.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <mutex>

namespace sahl {

namespace {

/// Samples of one pass over the picture.
struct Pass {
    std::uint32_t first, end;
    std::vector<bool> only; // pixels; empty: all
};

class Renderer {
  public:
    Renderer(PictureMaker const& maker, RenderOutcome& outcome, Progress const& progress,
             std::atomic<bool> const& stop)
        : maker_(maker), outcome_(outcome), progress_(progress), stop_(stop) {}

    void run(Pass const& pass, std::uint64_t passes_left) {
        std::uint64_t const total = done_ + maker_.tiles() * passes_left;
        tbb::parallel_for(
            tbb::blocked_range<std::uint64_t>(0, maker_.tiles(), 1),
            [&](tbb::blocked_range<std::uint64_t> const& tiles) {
                for (std::uint64_t tile = tiles.begin(); tile < tiles.end() && !stop_; ++tile) {
                    EventCounts counts{};
                    maker_.render_tile(outcome_.film, tile, pass.first, pass.end, pass.only, counts);
                    note(counts, total);
                }
            },
            tbb::simple_partitioner());
    }

  private:
    void note(EventCounts const& counts, std::uint64_t total) {
        std::scoped_lock const lock(mutex_);
        for (std::size_t i = 0; i < counts.size(); ++i)
            outcome_.ended[i] += counts[i];
        ++done_;
        if (progress_)
            progress_(done_, total);
    }

    PictureMaker const& maker_;
    RenderOutcome& outcome_;
    Progress const& progress_;
    std::atomic<bool> const& stop_;
    std::mutex mutex_;
    std::uint64_t done_ = 0; // tiles, of all passes
};

} // namespace

RenderOutcome render_scene(PictureMaker const& maker, PictureOptions const& options, unsigned threads,
                           Progress const& progress, std::atomic<bool> const& stop) {
    auto const start = std::chrono::steady_clock::now();
    std::clock_t const cpu_start = std::clock();
    RenderOutcome outcome{maker.empty_film()};
    outcome.threads = threads ? threads : static_cast<unsigned>(tbb::this_task_arena::max_concurrency());
    tbb::global_control const limit(tbb::global_control::max_allowed_parallelism, outcome.threads);
    Renderer renderer(maker, outcome, progress, stop);
    tbb::task_arena(static_cast<int>(outcome.threads)).execute([&] {
        if (options.adaptive <= 0.0 || options.samples < 2)
            return renderer.run({0, options.samples, {}}, 1);
        std::uint32_t const few = std::max(1U, options.samples / 4);
        renderer.run({0, few, {}}, 2);
        if (stop)
            return;
        Pass pass{few, options.samples, maker.that_differ(outcome.film)};
        outcome.sampled_again =
            static_cast<std::uint64_t>(std::count(pass.only.begin(), pass.only.end(), true));
        renderer.run(pass, 1);
    });
    outcome.whole = !stop;
    outcome.cpu_seconds = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return outcome;
}

} // namespace sahl

#include "run/side_by_side.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>

namespace sahl {

unsigned threads_of(unsigned threads) {
    return threads ? threads : static_cast<unsigned>(tbb::this_task_arena::max_concurrency());
}

void side_by_side(std::size_t count, unsigned threads, std::function<void(std::size_t)> const& work) {
    unsigned const all = threads_of(threads);
    tbb::global_control const limit(tbb::global_control::max_allowed_parallelism, all);
    tbb::task_arena arena(static_cast<int>(all));
    std::atomic<std::size_t> next = 0;
    auto const take = [&](std::size_t) {
        for (std::size_t i; (i = next++) < count;) {
            try {
                // isolated: a thread that waits for parts of its piece must not begin another one inside
                tbb::this_task_arena::isolate([&] { work(i); });
            } catch (...) {
                next = count;
                throw;
            }
        }
    };
    arena.execute([&] {
        tbb::parallel_for(std::size_t{0}, std::min<std::size_t>(all, count), take, tbb::simple_partitioner());
    });
}

} // namespace sahl

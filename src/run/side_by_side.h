// In: pieces of work that know nothing of each other. Out: all of them done, on all threads. With
// run/trace_scene.cpp the door to TBB.
#pragma once

#include <cstddef>
#include <functional>

namespace sahl {

/// How many threads that is; 0: all there are.
unsigned threads_of(unsigned threads);

/// Calls work(0) … work(count − 1), begun in this order, as many at once as there are threads. What `work`
/// does side by side itself has the threads that are left over. An exception ends it after the pieces begun.
void side_by_side(std::size_t count, unsigned threads, std::function<void(std::size_t)> const& work);

} // namespace sahl

// In: nothing. Out: the thread's CPU seconds, and the median of several.
#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

namespace sahl::bench {

inline double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

} // namespace sahl::bench

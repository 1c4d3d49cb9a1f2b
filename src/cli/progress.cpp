#include "cli/progress.h"

#include <cstdio>
#include <unistd.h>
#include <utility>

namespace sahl {

ProgressLine::ProgressLine(bool quiet) : visible_(!quiet && ::isatty(STDERR_FILENO)) {}

ProgressLine::~ProgressLine() {
    if (drawn_)
        std::fputs("\r\033[K", stderr);
}

void ProgressLine::begin(std::string label) {
    label_ = std::move(label);
    start_ = Clock::now();
}

void ProgressLine::show(std::uint64_t done, std::uint64_t total, char const* of) {
    auto const now = Clock::now();
    if (!visible_ || done == 0 || now - last_ < std::chrono::milliseconds(100))
        return;
    last_ = now;
    drawn_ = true;
    double const elapsed = std::chrono::duration<double>(now - start_).count();
    double const remaining = elapsed * static_cast<double>(total - done) / static_cast<double>(done);
    std::fprintf(stderr, "\r\033[K%s: %.0f %% of %llu %s, %.0f s left", label_.c_str(),
                 100.0 * static_cast<double>(done) / static_cast<double>(total),
                 static_cast<unsigned long long>(total), of, remaining);
    std::fflush(stderr);
}

} // namespace sahl

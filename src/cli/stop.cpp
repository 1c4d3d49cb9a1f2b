#include "cli/stop.h"

#include <csignal>
#include <cstdint>
#include <ctime>

namespace sahl {

namespace {

std::atomic<bool> stopped{false};
std::atomic<int> by{SIGINT};
std::atomic<std::int64_t> first_ms{0};

/// `timeout` signals a program, and then all of its group: what comes within this time is one wish.
constexpr std::int64_t one_wish_ms = 300;

std::int64_t now_ms() {
    std::timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now); // which a handler may call
    return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1000000;
}

extern "C" void stop_at(int signal) {
    if (!stopped) {
        by = signal;
        first_ms = now_ms();
        stopped = true;
    } else if (now_ms() - first_ms > one_wish_ms) { // a second time it means it
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}

} // namespace

std::atomic<bool> const& stop_on_signals() {
    for (int const signal : {SIGINT, SIGTERM})
        if (std::signal(signal, stop_at) == SIG_IGN)
            std::signal(signal, SIG_IGN);
    return stopped;
}

int status_when_stopped() {
    return 128 + by;
}

} // namespace sahl

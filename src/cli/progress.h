// In: how much is done. Out: a line on standard error with the time that remains, if a person is looking.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace sahl {

class ProgressLine {
  public:
    /// Silent if `quiet`, or if standard error is not a terminal.
    explicit ProgressLine(bool quiet);
    ~ProgressLine();
    void begin(std::string label);
    void show(std::uint64_t done, std::uint64_t total, char const* of = "rays");

  private:
    using Clock = std::chrono::steady_clock;
    bool visible_;
    bool drawn_ = false;
    std::string label_ = "tracing";
    Clock::time_point start_ = Clock::now(), last_{};
};

} // namespace sahl

// In: where a run's results shall stand. Out: a folder to write them in, put in its place when all are
// complete.
#pragma once

#include <filesystem>

namespace sahl {

/// While it lives, results go to a folder beside the wanted one; publish() puts that in its place. Not
/// published, it leaves everything as it was. What an earlier run left there is replaced; files that no run
/// writes are kept.
class RunFolder {
  public:
    /// Throws InputError where `wanted` holds files but no run, or cannot be written.
    explicit RunFolder(std::filesystem::path wanted);
    ~RunFolder();
    RunFolder(RunFolder const&) = delete;
    RunFolder& operator=(RunFolder const&) = delete;

    std::filesystem::path const& path() const { return work_; }
    void publish();

  private:
    std::filesystem::path wanted_, work_;
    bool published_ = false;
};

} // namespace sahl

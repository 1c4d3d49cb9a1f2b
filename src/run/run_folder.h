// In: where a run's results shall stand. Out: a folder to write them in, put in its place when all are
// complete.
#pragma once

#include <filesystem>
#include <string>

namespace sahl {

/// What becomes of an unfinished run that stands beside the folder.
enum class Unfinished {
    taken_up,     // if it is of the same identity; else it is removed
    same_goes_on, // the same, but one of another identity is an error
    removed,
};

/// While it lives, results go to a folder beside the wanted one; publish() puts that in its place. Not
/// published, it leaves everything as it was, but for complete runs of a sweep, and what is kept. What an
/// earlier run left there is replaced; files that no run writes are kept.
class RunFolder {
  public:
    /// Throws InputError where `wanted` holds files but no run, or cannot be written.
    /// identity   not empty: what is not finished stays in the folder `wanted`.partial, and the next start
    ///            with the same identity finds it there; one with another identity begins anew. Where
    ///            another process is at work in it, this one has a folder of its own, and finds nothing.
    explicit RunFolder(std::filesystem::path wanted, std::string const& identity = {},
                       Unfinished unfinished = Unfinished::taken_up);
    ~RunFolder();
    RunFolder(RunFolder const&) = delete;
    RunFolder& operator=(RunFolder const&) = delete;

    std::filesystem::path const& path() const { return work_; }
    void publish();
    /// What is there stays, for the next start with the same identity; false where there is none to find it.
    bool keep();

  private:
    bool claim_partial(std::string const& identity, Unfinished unfinished);

    std::filesystem::path wanted_, work_;
    bool published_ = false, kept_ = false;
    int lock_ = -1; // of the file that says whose partial results these are
};

} // namespace sahl

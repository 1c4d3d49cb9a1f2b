#include "run/run_folder.h"

#include "math/input_error.h"
#include "run/unfinished.h"

#include <algorithm>
#include <array>
#include <fcntl.h>
#include <fstream>
#include <string_view>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

namespace sahl {

namespace fs = std::filesystem;

namespace {

/// What a run writes; everything else in its folder is the user's.
constexpr std::array<std::string_view, 8> written{"summary.json", "rays.h5",  "rays.shards", "report.html",
                                                  "sweep.csv",    "goal.csv", "detectors",   "runs"};

bool is_written(fs::path const& name) {
    return std::find(written.begin(), written.end(), name.string()) != written.end();
}

constexpr char const* identity_file = "unfinished.json";

bool has_runs(fs::path const& folder) {
    std::error_code error;
    for (fs::directory_entry const& entry : fs::directory_iterator(folder / "runs", error))
        if (entry.path().extension() != ".part")
            return true;
    return false;
}

void remove_contents(fs::path const& folder, std::string_view but) {
    for (fs::directory_entry const& entry : fs::directory_iterator(folder))
        if (entry.path().filename() != but)
            fs::remove_all(entry.path());
}

std::string text_in(fs::path const& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace

/// Whether the partial folder is ours now; `work_` is its name.
bool RunFolder::claim_partial(std::string const& identity, Unfinished unfinished) {
    fs::path const file = work_ / identity_file;
    if (fs::exists(work_) && !fs::exists(file) && !fs::is_empty(work_))
        throw InputError(work_.string(), "stands where an unfinished run would be kept, and is none",
                         "move it away, or give another --out");
    fs::create_directories(work_);
    lock_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
        ::close(lock_);
        lock_ = -1;
    }
    if (lock_ < 0)
        return false;
    std::string const found = text_in(file);
    if (found != identity || unfinished == Unfinished::removed) {
        if (!found.empty() && unfinished == Unfinished::same_goes_on) {
            ::close(lock_);
            lock_ = -1;
            throw InputError(work_.string(),
                             "is of another experiment, other options, or a model that has changed since",
                             "trace without --resume to begin anew, which removes it, or give another --out");
        }
        remove_contents(work_, identity_file);
        std::ofstream out(file, std::ios::binary); // the same inode: the lock stays
        out << identity;
        if (!out.flush())
            throw InputError(file.string(), "cannot be written", "see that there is room on the disk");
    }
    return true;
}

RunFolder::RunFolder(fs::path wanted, std::string const& identity, Unfinished unfinished)
    : wanted_(std::move(wanted)) {
    std::error_code error;
    wanted_ = fs::absolute(wanted_).lexically_normal();
    if (!wanted_.has_filename())
        wanted_ = wanted_.parent_path(); // "out/" is "out"
    if (fs::exists(wanted_) && !fs::is_directory(wanted_))
        throw InputError(wanted_.string(), "is a file, not a folder", "give another --out");
    if (fs::is_directory(wanted_) && !fs::is_empty(wanted_) && !fs::exists(wanted_ / "summary.json"))
        throw InputError(wanted_.string(), "holds files, but no earlier run that could be replaced",
                         "give an --out that is new, empty, or an earlier run");
    work_ = wanted_;
    work_ += ".partial";
    if (!identity.empty() && claim_partial(identity, unfinished))
        return;
    work_ = wanted_;
    work_ += ".unfinished-" + std::to_string(::getpid());
    fs::remove_all(work_, error);
    fs::create_directories(work_, error);
    if (error)
        throw InputError(work_.string(), "cannot be made: " + error.message(),
                         "give an --out where you may write");
}

RunFolder::~RunFolder() {
    std::error_code ignored;
    if (!published_ && !kept_ && !(lock_ >= 0 && has_runs(work_)))
        fs::remove_all(work_, ignored);
    if (lock_ >= 0)
        ::close(lock_);
}

bool RunFolder::keep() {
    return kept_ = lock_ >= 0;
}

void RunFolder::publish() {
    fs::remove_all(work_ / unfinished_folder);
    fs::path const old = work_.string() + ".old";
    if (fs::exists(wanted_)) {
        fs::remove_all(old);
        for (fs::directory_entry const& entry : fs::directory_iterator(wanted_))
            if (!is_written(entry.path().filename()) && entry.path().filename() != identity_file)
                fs::rename(entry.path(), work_ / entry.path().filename());
        fs::rename(wanted_, old);
    }
    fs::rename(work_, wanted_);
    fs::remove(wanted_ / identity_file); // last: without it an unfinished folder would be nobody's
    published_ = true;
    fs::remove_all(old);
}

} // namespace sahl

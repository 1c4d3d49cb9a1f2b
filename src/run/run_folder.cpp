#include "run/run_folder.h"

#include "math/input_error.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace sahl {

namespace fs = std::filesystem;

namespace {

/// What a run writes; everything else in its folder is the user's.
constexpr std::array<std::string_view, 7> written{"summary.json", "rays.h5",   "rays.shards", "report.html",
                                                  "sweep.csv",    "detectors", "runs"};

bool is_written(fs::path const& name) {
    return std::find(written.begin(), written.end(), name.string()) != written.end();
}

} // namespace

RunFolder::RunFolder(fs::path wanted) : wanted_(std::move(wanted)) {
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
    work_ += ".unfinished-" + std::to_string(::getpid());
    fs::remove_all(work_, error);
    fs::create_directories(work_, error);
    if (error)
        throw InputError(work_.string(), "cannot be made: " + error.message(),
                         "give an --out where you may write");
}

RunFolder::~RunFolder() {
    std::error_code ignored;
    if (!published_)
        fs::remove_all(work_, ignored);
}

void RunFolder::publish() {
    fs::path const old = work_.string() + ".old";
    if (fs::exists(wanted_)) {
        for (fs::directory_entry const& entry : fs::directory_iterator(wanted_))
            if (!is_written(entry.path().filename()))
                fs::rename(entry.path(), work_ / entry.path().filename());
        fs::rename(wanted_, old);
    }
    fs::rename(work_, wanted_);
    published_ = true;
    fs::remove_all(old);
}

} // namespace sahl

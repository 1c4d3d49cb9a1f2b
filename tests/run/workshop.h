// In: an experiment. Out: runs of it that are killed and go on, and what they leave, to compare.
#pragma once

#include "run/run.h"
#include "support/bench.h"
#include "support/catch.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <sstream>
#include <thread>

namespace sahl::bench {

namespace fs = std::filesystem;

inline std::string bytes_of(fs::path const& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Every file of a run but the page, which tells its seconds too; of the summary without the lines that may
/// differ.
inline std::map<std::string, std::string> results_in(fs::path const& folder) {
    std::map<std::string, std::string> files;
    for (auto const& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file() || entry.path().filename() == "report.html")
            continue;
        std::string text = bytes_of(entry.path());
        if (entry.path().filename() == "summary.json") {
            std::istringstream lines(text);
            text.clear();
            for (std::string line; std::getline(lines, line);)
                if (line.find("second") == std::string::npos && line.find("\"threads\"") == std::string::npos)
                    text += line + "\n";
        }
        files[fs::relative(entry.path(), folder).string()] = std::move(text);
    }
    return files;
}

struct Workshop {
    Folder folder;
    fs::path const experiment = folder.path() / "ball.toml", out = folder.path() / "out",
                   partial = folder.path() / "out.partial";
    fs::path const shards = partial / "rays.shards.tmp";

    explicit Workshop(std::string const& text) { std::ofstream(experiment) << text; }

    pid_t start(std::vector<std::string> const& more = {}) const {
        std::vector<std::string> words{SAHL_PROGRAM, "trace",   experiment.string(), "--out",
                                       out.string(), "--quiet", "--threads",         "2"};
        words.insert(words.end(), more.begin(), more.end());
        pid_t const child = ::fork();
        if (child == 0) {
            ::signal(SIGINT, SIG_DFL); // which a script's background ignores, and its children with it
            std::vector<char*> arguments;
            for (std::string& word : words)
                arguments.push_back(word.data());
            arguments.push_back(nullptr);
            ::execv(SAHL_PROGRAM, arguments.data());
            ::_exit(127);
        }
        return child;
    }
    int finish(pid_t child) const {
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string shard(int number) const {
        char name[16];
        std::snprintf(name, sizeof name, "%05d.h5", number);
        return name;
    }
    /// Kills a run as soon as this is so, and so many microseconds after that; false where it was done
    /// before.
    bool kill_when(std::function<bool()> const& it_is_time, long microseconds,
                   std::vector<std::string> const& more = {}) const {
        return signal_when(SIGKILL, it_is_time, microseconds, more) == -1;
    }
    /// The same with another signal; returns the exit status.
    int signal_when(int signal, std::function<bool()> const& it_is_time, long microseconds,
                    std::vector<std::string> const& more = {}) const {
        fs::remove_all(out);
        fs::remove_all(partial);
        pid_t const child = start(more);
        auto const deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (!it_is_time() && !fs::exists(out) && std::chrono::steady_clock::now() < deadline)
            std::this_thread::sleep_for(std::chrono::microseconds(100));
        std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
        ::kill(child, signal);
        return finish(child);
    }
    /// Goes on in this process; returns how many rays were known to be done before.
    std::optional<std::uint64_t> go_on() const {
        RunOptions options;
        options.out = out;
        options.resume = true;
        std::optional<std::uint64_t> first;
        options.progress = [&](std::uint64_t done, std::uint64_t) { first = first.value_or(done); };
        run_experiment(load_experiment(experiment), options);
        return first;
    }
    /// Once so many shards are closed.
    bool kill_one(int closed, long microseconds) const {
        return kill_when([&] { return closed == 0 || fs::exists(shards / shard(closed - 1)); }, microseconds);
    }
    /// How many shards the killed run left, each of which reads as the whole run has it.
    int whole_shards(RayLogReader const& whole) const {
        int number = 0;
        for (; fs::exists(shards / shard(number)); ++number) {
            RayLogReader const one(shards / shard(number));
            auto const rows = one.read(0, UINT64_MAX),
                       expected = whole.read(std::uint64_t(number) * 16384, rows.size());
            std::size_t different = 0;
            for (std::size_t i = 0; i < rows.size(); ++i)
                different += rows[i].ray != expected[i].ray || rows[i].index != expected[i].index ||
                             rows[i].direction != expected[i].direction ||
                             rows[i].power_end != expected[i].power_end;
            CHECK(different == 0);
            CHECK(!rows.empty());
        }
        return number;
    }
};

} // namespace sahl::bench

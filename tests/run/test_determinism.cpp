// The same experiment gives the same bytes, whatever the number of threads.
#include "support/catch.h"

#include "run/run.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <unistd.h>

using namespace sahl;

namespace {

std::string bytes_of(std::filesystem::path const& file) {
    std::ifstream in(file, std::ios::binary);
    REQUIRE(in.good());
    return {std::istreambuf_iterator<char>(in), {}};
}

/// All files of the log, one after another.
std::string bytes_of_log(std::filesystem::path const& folder) {
    std::string bytes = bytes_of(folder / "rays.h5");
    std::set<std::filesystem::path> shards;
    if (std::filesystem::exists(folder / "rays.shards"))
        for (auto const& entry : std::filesystem::directory_iterator(folder / "rays.shards"))
            shards.insert(entry.path());
    for (auto const& shard : shards)
        bytes += shard.filename().string() + bytes_of(shard);
    return bytes;
}

/// summary.json without what is allowed to differ.
std::string without_times(std::string const& text) {
    std::string kept;
    std::size_t at = 0;
    while (at < text.size()) {
        std::size_t const end = text.find('\n', at);
        std::string const line = text.substr(at, end == text.npos ? text.npos : end + 1 - at);
        bool const time = line.find("\"seconds\"") != line.npos ||
                          line.find("\"segments_per_second\"") != line.npos ||
                          line.find("\"threads\"") != line.npos;
        kept += time ? "" : line;
        at += line.size();
    }
    return kept;
}

void check_same_bytes(std::filesystem::path const& file, std::vector<std::string> const& set) {
    std::filesystem::path const out =
        std::filesystem::temp_directory_path() / ("sahl-test-determinism-" + std::to_string(::getpid()));
    std::string log, summary;
    for (unsigned const threads : {1u, 2u, 7u}) {
        CAPTURE(threads);
        RunOptions options;
        options.out = out;
        options.threads = threads;
        RunResult const result = run_experiment(load_experiment(file, set), options);
        CHECK(result.failures.empty());
        if (threads == 1) {
            log = bytes_of_log(out);
            summary = without_times(bytes_of(out / "summary.json"));
            CHECK(log.size() > 1000000);
        } else {
            CHECK((bytes_of_log(out) == log));
            CHECK(without_times(bytes_of(out / "summary.json")) == summary);
        }
    }
    std::filesystem::remove_all(out);
}

std::filesystem::path experiment(std::string const& name) {
    return std::filesystem::path(SAHL_SOURCE_DIR) / "experiments" / name / (name + ".toml");
}

} // namespace

TEST_CASE("one, two and seven threads write the same bytes, splitting") {
    check_same_bytes(experiment("ball-lens"), {"source.beam.beam.rays=20000", "trace.log=true"});
}

TEST_CASE("one, two and seven threads write the same bytes, drawing branches and points at random") {
    check_same_bytes(experiment("mesh-lens"),
                     {"source.left beam.beam.rays=10000", "source.left beam.beam.pattern=random",
                      "source.right beam.beam.rays=9000", "trace.branch=roulette", "trace.log=true"});
}

TEST_CASE("one, two and seven threads write the same bytes, compressed and in shards") {
    check_same_bytes(experiment("ball-lens"), {"source.beam.beam.rays=20000", "trace.log=true",
                                               "log.compress=true", "log.shard_rows=16384"});
}

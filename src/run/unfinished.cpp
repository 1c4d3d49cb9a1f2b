#include "run/unfinished.h"

#include "record/crc32.h"
#include "record/disk.h"
#include "scene/read_file.h"

#include <bit>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <span>
#include <system_error>

namespace sahl {

namespace fs = std::filesystem;

namespace {

constexpr char const* remedy = "see that there is room on the disk";
constexpr double share_of_time = 0.05; // that keeping may take

void write_whole(fs::path const& file, std::string const& bytes) {
    fs::path temporary = file;
    temporary += ".tmp";
    fs::create_directories(file.parent_path());
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out << bytes;
    out.close();
    if (!out)
        throw InputError(file.string(), "cannot be written", remedy);
    sync_to_disk(temporary, remedy);
    move_on_disk(temporary, file, remedy);
}

std::optional<std::string> bytes_of(fs::path const& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in)
        return {};
    return std::string{std::istreambuf_iterator<char>(in), {}};
}

/// Behind the bytes stands their checksum.
std::string checksum(std::string const& bytes) {
    std::uint32_t const crc = crc32_after(0, std::as_bytes(std::span(bytes)));
    std::string text(sizeof crc, '\0');
    std::memcpy(text.data(), &crc, sizeof crc);
    return text;
}

fs::path look_at(fs::path const& run, double at) {
    char name[32];
    std::snprintf(name, sizeof name, "%016llx.json",
                  static_cast<unsigned long long>(std::bit_cast<std::uint64_t>(at)));
    return run / unfinished_folder / name;
}

} // namespace

KnownSoFar known_in(fs::path const& run, bool resume, double seconds) {
    using Clock = std::chrono::steady_clock;
    fs::path const file = run / unfinished_folder / "known.bin";
    KnownSoFar known;
    std::error_code ignored;
    if (auto bytes = resume ? bytes_of(file) : std::nullopt; bytes && bytes->size() >= 4) {
        std::string const sum = bytes->substr(bytes->size() - 4);
        bytes->resize(bytes->size() - 4);
        if (checksum(*bytes) == sum)
            known.before = std::move(bytes);
    }
    if (!known.before)
        fs::remove(file, ignored);
    auto next = std::make_shared<Clock::time_point>(
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)));
    known.due = [next] { return Clock::now() >= *next; };
    known.keep = [file, next, seconds](std::string const& bytes) {
        auto const start = Clock::now();
        write_whole(file, bytes + checksum(bytes));
        std::chrono::duration<double> const took = Clock::now() - start;
        *next = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(
                                   std::max(seconds, took.count() / share_of_time)));
    };
    return known;
}

std::optional<Value> kept_look(fs::path const& run, double at) {
    fs::path const file = look_at(run, at);
    auto const text = run.empty() ? std::nullopt : bytes_of(file);
    return text ? std::optional(parse_json(*text, file.string())) : std::nullopt;
}

void keep_look(fs::path const& run, double at, Value const& summary) {
    if (!run.empty())
        write_whole(look_at(run, at), to_json(summary));
}

} // namespace sahl

// In: the shards of a log. Out: the file beside them that lists them with checksums, and says where a run
// that was stopped may go on; see docs/ray-log.md.
#pragma once

#include "record/log_file.h"
#include "record/ray_log.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sahl {

struct ListedShard {
    std::string name; // in the folder of shards
    std::uint64_t rows = 0, first_ray = 0, bytes = 0;
    std::uint32_t crc32 = 0;
};

/// What a run knew when it had traced some of its rays: the log's rows up to `rows` are theirs.
struct LogCheckpoint {
    std::uint64_t rows = 0;
    std::string state;
};

struct LogManifest {
    std::uint64_t shard_rows = 0;
    bool complete = false;
    std::vector<ListedShard> shards;
    std::optional<LogCheckpoint> checkpoint;
};

inline constexpr char const* manifest_name = "manifest.json";

/// Writes manifest.json, and the checkpoint beside it, each under a temporary name, synced and renamed.
void write_manifest(std::filesystem::path const& folder, LogHeader const& header, LogManifest const& manifest,
                    std::string const& remedy);

/// What a stopped run left in the folder, as far as it is whole: shards from the first on whose bytes are
/// those that are listed. None if nothing can go on from there, or if it is of another run.
std::optional<LogManifest> read_manifest(std::filesystem::path const& folder, LogHeader const& header,
                                         std::uint64_t shard_rows);

/// Of a file's bytes, as zlib and gzip have it. Throws InputError where it cannot be read.
std::uint32_t crc32_of(std::filesystem::path const& file);

} // namespace sahl

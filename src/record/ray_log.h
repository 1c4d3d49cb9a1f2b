// In: segments in order. Out: rays.h5, and its rows again.
// The layout is described in docs/ray-log.md; columns and codes are those of the contract.
#pragma once

#include "record/log_block.h"
#include "trace/segment.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sahl {

/// What a log needs to be understood without the experiment: names by id, and who wrote it.
struct LogHeader {
    std::string program; // "sahl 0.1.0"
    std::string title;
    std::string experiment_text; // the file as read
    std::string options_json;    // what was run, with --set and all options
    std::string experiment_sha256;
    std::uint64_t seed = 0;
    std::uint64_t every = 1;  // rays whose number is a multiple of this are in the log
    bool digits_lost = false; // rows tell them
    double min_power = 0.0;   // what began with less than this share of its ray's power is not in the log
    std::string where;        // the filter whose paths are in the log; empty: all
    std::vector<std::string> sources;
    std::vector<double> source_power_W;
    std::vector<std::uint64_t>
        source_first_ray;                 // number of each source's first ray; one more entry: the total
    std::vector<std::string> surfaces;    // by FaceId: "lens.front"
    std::vector<std::string> media;       // by MediumId
    std::vector<std::string> models;      // paths of the model files, as the experiment names them
    std::vector<double> wavelengths_m;    // all distinct ones
    std::vector<double> refractive_index; // row-major [medium][wavelength]
};

struct RayLogOptions {
    bool compress = false; // shuffle and deflate, which every HDF5 undoes
    std::uint64_t shard_rows = std::uint64_t{256} * chunk_rows; // in one file; see whole_chunks
};

/// The least multiple of chunk_rows from this number of rows on.
constexpr std::uint64_t whole_chunks(std::uint64_t rows) {
    return (rows + chunk_rows - 1) / chunk_rows * chunk_rows;
}

/// Whether a log of the same run that was stopped goes on.
enum class LogStart { anew, where_it_was_stopped };

/// Writes rays.h5 under a temporary name beside `file`; close() syncs and renames it. A log longer than
/// shard_rows becomes a folder of shards beside `file`, each closed, synced and renamed as soon as it is
/// full, and `file` shows them as one; a manifest beside them lists them with checksums. Destroyed unclosed
/// and not left, it removes what it wrote. The same rows give the same bytes, in whatever portions they come,
/// stopped and gone on with or not.
class RayLogWriter {
  public:
    RayLogWriter(std::filesystem::path file, LogHeader const& header, RayLogOptions const& options = {},
                 LogStart start = LogStart::anew);
    RayLogWriter(RayLogWriter&&) noexcept;
    ~RayLogWriter();

    /// A batch of rays passes through four hands: block() takes its segments, and place(), pack() and write()
    /// pass it on. Batches may be in block() and pack() at once; place() and write() must get one after
    /// another, in the order of rays.
    LogBlock block() const;
    std::vector<LogChunk> place(LogBlock block);
    void pack(std::vector<LogChunk>& chunks) const;
    void write(std::vector<LogChunk> chunks);
    /// Where a stopped log goes on: what was given to `remember`, and the rows that were placed before; none
    /// where it begins at its first row. The rows that follow those are to be placed again.
    struct Resumed {
        std::string state;
        std::uint64_t rows = 0;
    };
    std::optional<Resumed> const& resumed() const;
    /// Whether a shard gets full by so many rows more: then, before they are placed, is the moment to
    /// remember what is known of all rows so far.
    bool fills_shard(std::uint64_t rows) const;
    void remember(std::string state);
    /// All four at once.
    void append(std::span<Segment const> segments);

    void close();
    /// Stopped on the way: the shards that are closed stay, for LogStart::where_it_was_stopped.
    void leave();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Reads rays.h5; a bad file is an InputError.
class RayLogReader {
  public:
    /// `path` is the file, or the folder of a run that has a rays.h5.
    explicit RayLogReader(std::filesystem::path const& path);
    RayLogReader(RayLogReader&&) noexcept;
    ~RayLogReader();
    LogHeader const& header() const;
    std::uint64_t rows() const;
    std::uint64_t rays() const; // number of the last ray + 1; 0 for an empty log
    /// Rows [first, first + count), clamped to the end.
    std::vector<Segment> read(std::uint64_t first, std::uint64_t count) const;
    /// All rows of one ray, found by bisection; empty if the log has none.
    std::vector<Segment> read_ray(std::uint64_t ray) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace sahl

// In: the segments of a batch. Out: the same as packed rows, and chunks of the log made of them.
#pragma once

#include "record/log_rows.h"

#include <cstdint>
#include <vector>

namespace sahl {

/// Packs what it takes; a batch's rows on their way to a RayLogWriter.
class LogBlock final : public SegmentSink {
  public:
    explicit LogBlock(std::shared_ptr<LogMemory> memory) : memory_(std::move(memory)) {}
    void take(std::span<Segment const> segments) override;
    std::vector<LogRows> const& pieces() const { return pieces_; }
    std::vector<LogRows> release() { return std::move(pieces_); }
    std::uint64_t rows() const;

  private:
    std::shared_ptr<LogMemory> memory_;
    std::vector<LogRows> pieces_; // all are full but the last
    WavelengthInNm nm_;
};

/// A chunk of every column.
struct LogChunk {
    LogRows rows;
    std::vector<std::vector<std::byte>> compressed; // by column; none: as they are
};

/// Fills chunk after chunk with the rows of blocks.
class LogChunker {
  public:
    explicit LogChunker(std::shared_ptr<LogMemory> memory) : memory_(std::move(memory)), filling_(memory_) {}
    /// The next so many rows are passed over: they stand in the log already.
    void pass_over(std::uint64_t rows) { passed_over_ = rows; }
    /// The chunks that become full.
    std::vector<LogChunk> add(LogBlock block);
    /// What has been left over so far, if anything, the rows that are missing in it zero.
    std::vector<LogChunk> rest();

  private:
    std::shared_ptr<LogMemory> memory_;
    LogRows filling_;
    std::uint64_t passed_over_ = 0;
};

/// Compresses each column's chunk: bytes shuffled (all first bytes, all second ones, …), then deflated in
/// zlib's format; what HDF5's filters of these names undo.
void compress(LogChunk& chunk);

} // namespace sahl

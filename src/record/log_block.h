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

/// Rows [first, first + count) of a piece that several chunks may share.
struct LogSlice {
    std::shared_ptr<LogRows const> rows;
    std::size_t first = 0, count = 0;
    std::span<std::byte const> column(std::size_t number) const { return rows->column(number, first, count); }
};

/// A chunk of every column, as slices of what was packed: its rows are not copied together.
struct LogChunk {
    std::vector<LogSlice> slices;
    std::vector<std::vector<std::byte>> compressed; // by column; none: as they are
    std::size_t rows() const;                       // up to chunk_rows
};

/// Fills chunk after chunk with the rows of blocks.
class LogChunker {
  public:
    explicit LogChunker(std::shared_ptr<LogMemory> memory) : memory_(std::move(memory)) {}
    /// The next so many rows are passed over: they stand in the log already.
    void pass_over(std::uint64_t rows) { passed_over_ = rows; }
    /// The chunks that become full.
    std::vector<LogChunk> add(LogBlock block);
    /// What has been left over so far, if anything.
    std::vector<LogChunk> rest();

  private:
    void fill(LogSlice slice, std::vector<LogChunk>& full);
    void gather(LogRows const& piece, std::size_t first, std::vector<LogChunk>& full);

    std::shared_ptr<LogMemory> memory_;
    LogChunk filling_;
    std::size_t filled_ = 0;            // rows of it
    std::shared_ptr<LogRows> gathered_; // of small pieces, the last of those begun
    std::uint64_t passed_over_ = 0;
};

/// Compresses each column's chunk: bytes shuffled (all first bytes, all second ones, …), then deflated in
/// zlib's format; what HDF5's filters of these names undo.
void compress(LogChunk& chunk);

} // namespace sahl

// In: the segments of a batch. Out: the same as packed rows, and chunks of the log made of them; see
// log_block.h.
#include "record/log_block.h"

#include <algorithm>
#include <utility>

namespace sahl {

namespace {

/// A piece of fewer rows is copied: sharing it would hold on to the memory of a whole one.
constexpr std::size_t least_shared = chunk_rows / 4;

} // namespace

void LogBlock::take(std::span<Segment const> segments) {
    while (!segments.empty()) {
        if (pieces_.empty() || pieces_.back().room() == 0)
            pieces_.emplace_back(memory_);
        auto const part = segments.first(std::min(segments.size(), pieces_.back().room()));
        pieces_.back().append(part, nm_);
        segments = segments.subspan(part.size());
    }
}

std::uint64_t LogBlock::rows() const {
    std::uint64_t sum = 0;
    for (LogRows const& piece : pieces_)
        sum += piece.size();
    return sum;
}

std::size_t LogChunk::rows() const {
    std::size_t sum = 0;
    for (LogSlice const& slice : slices)
        sum += slice.count;
    return sum;
}

std::vector<LogChunk> LogChunker::add(LogBlock block) {
    std::vector<LogChunk> full;
    for (LogRows& piece : block.release()) {
        std::size_t const first = std::min<std::uint64_t>(passed_over_, piece.size());
        passed_over_ -= first;
        if (std::size_t const count = piece.size() - first; count < least_shared)
            gather(piece, first, full);
        else
            fill({std::make_shared<LogRows const>(std::move(piece)), first, count}, full);
    }
    return full;
}

void LogChunker::fill(LogSlice slice, std::vector<LogChunk>& full) {
    while (slice.count > 0) {
        std::size_t const count = std::min(slice.count, chunk_rows - filled_);
        auto& slices = filling_.slices;
        if (!slices.empty() && slices.back().rows == slice.rows) // what was gathered goes on
            slices.back().count += count;
        else
            slices.push_back({slice.rows, slice.first, count});
        filled_ += count;
        slice.first += count;
        slice.count -= count;
        if (filled_ == chunk_rows) {
            full.push_back(std::exchange(filling_, {}));
            filled_ = 0;
        }
    }
}

/// Rows are only put behind those that chunks have of it already.
void LogChunker::gather(LogRows const& piece, std::size_t first, std::vector<LogChunk>& full) {
    while (first < piece.size()) {
        if (!gathered_ || gathered_->room() == 0)
            gathered_ = std::make_shared<LogRows>(memory_);
        std::size_t const count = std::min(piece.size() - first, gathered_->room());
        gathered_->append(piece, first, count);
        fill({gathered_, gathered_->size() - count, count}, full);
        first += count;
    }
}

std::vector<LogChunk> LogChunker::rest() {
    std::vector<LogChunk> last;
    if (filled_ > 0)
        last.push_back(std::exchange(filling_, {}));
    filled_ = 0;
    return last;
}

} // namespace sahl

// In: the segments of a batch. Out: the same as packed rows, and chunks of the log made of them; see
// log_block.h.
#include "record/log_block.h"

#include <algorithm>
#include <utility>

namespace sahl {

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

std::vector<LogChunk> LogChunker::add(LogBlock block) {
    std::vector<LogChunk> full;
    for (LogRows& piece : block.release()) {
        std::size_t const passed = std::min<std::uint64_t>(passed_over_, piece.size());
        passed_over_ -= passed;
        if (passed == 0 && filling_.size() == 0 && piece.room() == 0) { // a chunk as it is
            full.push_back({std::move(piece), {}});
            continue;
        }
        for (std::size_t done = passed; done < piece.size();) {
            std::size_t const count = std::min(piece.size() - done, filling_.room());
            filling_.append(piece, done, count);
            done += count;
            if (filling_.room() == 0)
                full.push_back({std::exchange(filling_, LogRows(memory_)), {}});
        }
    }
    return full;
}

std::vector<LogChunk> LogChunker::rest() {
    std::vector<LogChunk> last;
    if (filling_.size() > 0) {
        filling_.zero_the_rest();
        last.push_back({std::exchange(filling_, LogRows(memory_)), {}});
    }
    return last;
}

} // namespace sahl

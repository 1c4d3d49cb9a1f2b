// In: segments. Out: their rows, the values of each column together; see log_rows.h.
#include "record/log_rows.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace sahl {

namespace {

constexpr std::size_t block_rows = 32; // few enough that they and the ends of all columns stay in L1
// Columns are moved against each other by a few cache lines: a whole power of two would map their ends to the
// same few places of the cache.
constexpr std::size_t stagger = 192;

struct Layout {
    std::vector<std::size_t> widths, starts;
    std::size_t bytes = 0;
};

Layout made_layout(bool digits_lost) {
    Layout made;
    WavelengthInNm unused;
    visit_columns(unused, digits_lost, [&](ColumnInfo, auto get, auto) {
        made.widths.push_back(sizeof(Stored<decltype(get(Segment{}))>));
        made.starts.push_back(made.bytes);
        made.bytes += chunk_rows * made.widths.back() + stagger;
    });
    return made;
}

Layout const& layout(bool digits_lost) {
    static Layout const usual = made_layout(false), with_digits = made_layout(true);
    return digits_lost ? with_digits : usual;
}

} // namespace

std::span<std::size_t const> column_widths(bool digits_lost) {
    return layout(digits_lost).widths;
}

std::unique_ptr<std::byte[]> LogMemory::take() {
    {
        std::lock_guard const lock(mutex_);
        if (!unused_.empty()) {
            auto memory = std::move(unused_.back());
            unused_.pop_back();
            return memory;
        }
    }
    return std::unique_ptr<std::byte[]>(new std::byte[layout(digits_lost_).bytes]);
}

void LogMemory::give_back(std::unique_ptr<std::byte[]> memory) {
    std::lock_guard const lock(mutex_);
    unused_.push_back(std::move(memory));
}

LogRows::LogRows(std::shared_ptr<LogMemory> memory)
    : memory_(std::move(memory)), bytes_(memory_->take()), digits_lost_(memory_->digits_lost()) {}

LogRows::~LogRows() {
    if (bytes_)
        memory_->give_back(std::move(bytes_));
}

std::byte* LogRows::at(std::size_t column, std::size_t row) const {
    return bytes_.get() + layout(digits_lost_).starts[column] + row * layout(digits_lost_).widths[column];
}

void LogRows::append(std::span<Segment const> segments, WavelengthInNm& nm) {
    assert(segments.size() <= room());
    while (!segments.empty()) {
        auto const block = segments.first(std::min(segments.size(), block_rows));
        std::size_t number = 0;
        visit_columns(nm, digits_lost_, [&](ColumnInfo, auto get, auto) {
            using T = Stored<decltype(get(Segment{}))>;
            std::byte* place = at(number++, size_);
            for (Segment const& segment : block) {
                T const value = static_cast<T>(get(segment));
                std::memcpy(place, &value, sizeof value);
                place += sizeof value;
            }
        });
        size_ += block.size();
        segments = segments.subspan(block.size());
    }
}

void LogRows::append(LogRows const& others, std::size_t first, std::size_t count) {
    assert(count <= room() && first + count <= others.size());
    for (std::size_t column = 0; column < layout(digits_lost_).widths.size(); ++column)
        std::memcpy(at(column, size_), others.at(column, first), count * layout(digits_lost_).widths[column]);
    size_ += count;
}

std::span<std::byte const> LogRows::column(std::size_t number, std::size_t first, std::size_t count) const {
    return {at(number, first), count * layout(digits_lost_).widths[number]};
}

} // namespace sahl

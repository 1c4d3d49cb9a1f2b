// In: segments. Out: their rows, the values of each column together as a chunk of the log has them.
#pragma once

#include "record/log_columns.h"
#include "trace/segment.h"

#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace sahl {

inline constexpr std::size_t chunk_rows =
    16384; // 128 KiB of doubles: eight fit the chunk cache of a reader, 1 MiB

/// Bytes of a value, by column.
std::span<std::size_t const> column_widths(bool digits_lost);

/// Memory for rows, used again and again: to ask the system for fresh pages costs as much as to fill them.
class LogMemory {
  public:
    explicit LogMemory(bool digits_lost) : digits_lost_(digits_lost) {}
    bool digits_lost() const { return digits_lost_; } // rows have that column
    std::unique_ptr<std::byte[]> take();
    void give_back(std::unique_ptr<std::byte[]> memory);

  private:
    bool digits_lost_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<std::byte[]>> unused_;
};

/// Up to chunk_rows rows.
class LogRows {
  public:
    explicit LogRows(std::shared_ptr<LogMemory> memory);
    LogRows(LogRows&&) noexcept = default;
    LogRows& operator=(LogRows&&) noexcept = default;
    ~LogRows();
    std::size_t size() const { return size_; }
    std::size_t room() const { return chunk_rows - size_; }
    /// Puts rows behind those that are there; there must be room.
    void append(std::span<Segment const> segments, WavelengthInNm& nm);
    /// The same with rows [first, first + count) of others.
    void append(LogRows const& others, std::size_t first, std::size_t count);
    /// A column's values of the rows [first, first + count).
    std::span<std::byte const> column(std::size_t number, std::size_t first, std::size_t count) const;
    bool digits_lost() const { return digits_lost_; } // has that column

  private:
    std::byte* at(std::size_t column, std::size_t row) const;

    std::shared_ptr<LogMemory> memory_;
    std::unique_ptr<std::byte[]> bytes_;
    std::size_t size_ = 0;
    bool digits_lost_ = false;
};

} // namespace sahl

// In: a chunk of every column. Out: the same, shuffled and deflated; see log_block.h. And bytes' checksum.
// The only file that includes <libdeflate.h>.
#include "record/crc32.h"
#include "record/log_block.h"

#include <libdeflate.h>

#include <new>

namespace sahl {

namespace {

constexpr int level = 1; // doubles hardly shrink further at a higher one, and take twice as long

/// All first bytes of the values, then all second ones, …
void shuffle(std::span<std::byte const> values, std::size_t width, std::byte* out) {
    std::size_t const count = values.size() / width;
    for (std::size_t byte = 0; byte < width; ++byte)
        for (std::size_t i = 0; i < count; ++i)
            *out++ = values[i * width + byte];
}

} // namespace

std::uint32_t crc32_after(std::uint32_t crc, std::span<std::byte const> bytes) {
    return libdeflate_crc32(crc, bytes.data(), bytes.size());
}

void compress(LogChunk& chunk) {
    std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> const compressor(
        libdeflate_alloc_compressor(level), libdeflate_free_compressor);
    if (!compressor)
        throw std::bad_alloc();
    std::vector<std::byte> shuffled(chunk_rows * sizeof(double));
    for (std::size_t i = 0; i < column_widths(chunk.rows.digits_lost()).size(); ++i) {
        std::span<std::byte const> const bytes = chunk.rows.column(i);
        shuffle(bytes, column_widths(chunk.rows.digits_lost())[i], shuffled.data());
        std::vector<std::byte>& out = chunk.compressed.emplace_back();
        out.resize(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
        out.resize(libdeflate_zlib_compress(compressor.get(), shuffled.data(), bytes.size(), out.data(),
                                            out.size()));
    }
}

} // namespace sahl

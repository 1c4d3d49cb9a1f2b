// In: bytes. Out: their checksum, that of zlib and gzip.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace sahl {

/// crc   of the bytes before these; 0 at the beginning
std::uint32_t crc32_after(std::uint32_t crc, std::span<std::byte const> bytes);

} // namespace sahl

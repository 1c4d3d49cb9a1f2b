// In: bytes. Out: their SHA-256. The door to OpenSSL's libcrypto.
#pragma once

#include <string>
#include <string_view>

namespace sahl {

/// 64 lowercase hexadecimal digits.
std::string sha256(std::string_view bytes);

} // namespace sahl

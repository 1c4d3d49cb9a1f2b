#include "run/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace sahl {

std::string sha256(std::string_view bytes) {
    std::array<unsigned char, 32> digest{};
    unsigned length = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
        throw std::runtime_error("libcrypto has no SHA-256");
    std::string hex;
    for (unsigned char const byte : digest)
        for (int const nibble : {byte >> 4, byte & 15})
            hex += "0123456789abcdef"[nibble];
    return hex;
}

} // namespace sahl

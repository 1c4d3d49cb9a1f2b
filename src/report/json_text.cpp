#include "report/json_text.h"

#include <array>

namespace sahl::report {

void append_base64(std::string& out, std::span<unsigned char const> bytes) {
    constexpr char const* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    out.reserve(out.size() + (bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::size_t const here = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8U | (k < here ? bytes[i + k] : 0U);
        std::array<char, 4> four{};
        for (std::size_t k = 0; k < 4; ++k)
            four[k] = k <= here ? digits[word >> (18U - 6U * k) & 63U] : '=';
        out.append(four.data(), four.size());
    }
}

JsonText& JsonText::raw(std::string_view text) {
    separated();
    for (char const c : text) // outside of texts JSON has no "<"
        if (c == '<')
            text_ += "\\u003c";
        else
            text_ += c;
    fresh_ = false;
    return *this;
}

JsonText& JsonText::key(std::string_view name) {
    value(name);
    text_ += ':';
    fresh_ = true;
    return *this;
}

JsonText& JsonText::value(Value const& tree) {
    return raw(to_json(tree));
}

JsonText& JsonText::value(std::string_view text) {
    return value(Value{std::string(text), {}});
}

JsonText& JsonText::value(double number) {
    return value(Value{number, {}});
}

JsonText& JsonText::value(dvec3 const& v, double scale) {
    open('[');
    for (int axis = 0; axis < 3; ++axis)
        value(scale * v[axis]);
    return close(']');
}

} // namespace sahl::report

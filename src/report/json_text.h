// In: numbers, texts, arrays of numbers. Out: JSON that may stand in a <script> of a page: "<" is escaped
// everywhere, so that no text can end it. Arrays of numbers are base64 of their little-endian bytes.
#pragma once

#include "math/vec.h"
#include "scene/value.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace sahl::report {

/// Base64 (RFC 4648) of bytes.
void append_base64(std::string& out, std::span<unsigned char const> bytes);

/// Writes JSON piece by piece; commas come by themselves.
class JsonText {
  public:
    JsonText& open(char bracket) { return separated().put(bracket); }
    JsonText& close(char bracket) {
        text_ += bracket;
        fresh_ = false;
        return *this;
    }
    JsonText& key(std::string_view name);
    JsonText& value(Value const& tree);
    JsonText& value(std::string_view text);
    JsonText& value(char const* text) { return value(std::string_view(text)); }
    JsonText& value(bool truth) { return raw(truth ? "true" : "false"); }
    JsonText& value(double number); // null where it is not finite
    JsonText& value(std::uint64_t number) { return raw(std::to_string(number)); }
    JsonText& value(std::int64_t number) { return raw(std::to_string(number)); }
    JsonText& value(std::uint32_t number) { return value(std::uint64_t{number}); }
    JsonText& value(dvec3 const& v, double scale = 1.0);
    template <class T>
    JsonText& entry(std::string_view name, T const& what) {
        return key(name).value(what);
    }
    /// {"f64": "…"}, or f32, u32, i32, u16, i16, u8 by the type of number.
    template <class Number>
    JsonText& array(std::string_view name, std::span<Number const> numbers) {
        constexpr char kind = std::is_floating_point_v<Number> ? 'f' : std::is_signed_v<Number> ? 'i' : 'u';
        key(name).open('{').key(kind + std::to_string(8 * sizeof(Number)));
        auto const* const bytes = reinterpret_cast<unsigned char const*>(numbers.data());
        separated().put('"');
        append_base64(text_, {bytes, numbers.size_bytes()});
        text_ += '"';
        return close('}');
    }
    template <class Numbers>
    JsonText& array(std::string_view name, Numbers const& numbers) {
        return array(name, std::span<typename Numbers::value_type const>(numbers));
    }
    std::string take() { return std::move(text_); }

  private:
    JsonText& separated() {
        if (!fresh_)
            text_ += ',';
        fresh_ = true;
        return *this;
    }
    JsonText& put(char c) {
        text_ += c;
        return *this;
    }
    JsonText& raw(std::string_view text);

    std::string text_;
    bool fresh_ = true; // behind a bracket or a key, where no comma belongs
};

} // namespace sahl::report

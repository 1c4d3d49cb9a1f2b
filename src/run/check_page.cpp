#include "run/check_page.h"

#include <algorithm>
#include <cstdio>

namespace sahl {

std::string string_at(Value const& table, char const* key) {
    Value const* const found = table.find(key);
    auto const* const text = found ? std::get_if<std::string>(&found->data) : nullptr;
    return text ? *text : "";
}

double number_of(Value const& value) {
    if (auto const* const whole = std::get_if<std::int64_t>(&value.data))
        return static_cast<double>(*whole);
    auto const* const number = std::get_if<double>(&value.data);
    return number ? *number : 0.0;
}

double number_at(Value const& table, char const* key) {
    Value const* const found = table.find(key);
    return found ? number_of(*found) : 0.0;
}

std::uint64_t count_at(Value const& table, char const* key) {
    return static_cast<std::uint64_t>(number_at(table, key));
}

bool is_true(Value const& table, char const* key) {
    Value const* const found = table.find(key);
    auto const* const flag = found ? std::get_if<bool>(&found->data) : nullptr;
    return flag && *flag;
}

Table const& table_at(Value const& table, char const* key) {
    static Table const none;
    Value const* const found = table.find(key);
    auto const* const entries = found ? std::get_if<Table>(&found->data) : nullptr;
    return entries ? *entries : none;
}

Array const& list_at(Value const& table, char const* key) {
    static Array const none;
    Value const* const found = table.find(key);
    auto const* const entries = found ? std::get_if<Array>(&found->data) : nullptr;
    return entries ? *entries : none;
}

std::string joined(Array const& numbers, char const* between, char const* format) {
    std::string text;
    for (Value const& number : numbers) {
        char digits[40];
        std::snprintf(digits, sizeof digits, format, number_of(number));
        text += (text.empty() ? "" : between) + std::string(digits);
    }
    return text;
}

std::string wrapped(std::string const& text, std::string const& first, std::string const& margin) {
    constexpr std::size_t width = 100;
    std::string out = first, line;
    std::size_t used = first.size();
    for (std::size_t begin = 0; begin < text.size();) {
        std::size_t const end = std::min(text.find(' ', begin), text.size());
        std::string const word = text.substr(begin, end - begin);
        if (used + word.size() > width && used > margin.size()) {
            out += "\n" + margin;
            used = margin.size();
        } else if (begin > 0) {
            out += " ";
            ++used;
        }
        out += word;
        used += word.size();
        begin = end + 1;
    }
    return out + "\n";
}

} // namespace sahl

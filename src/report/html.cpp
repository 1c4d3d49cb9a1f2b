#include "report/html.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace sahl::report {

namespace {

/// A coordinate in mm or a part of a direction below this is rounding: a millionth of a nanometre.
constexpr double least_part = 1e-12;

bool is_continuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

std::string printed(char const* format, int digits, double value) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, digits, value);
    return buffer.data();
}

std::string with_true_minus(std::string const& number) {
    return !number.empty() && number.front() == '-' ? "−" + number.substr(1) : number;
}

} // namespace

std::string escaped(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (char const c : text)
        switch (c) {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '"':
            out += "&quot;";
            break;
        case '\'':
            out += "&#39;";
            break;
        default:
            if ((static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7F)
                out += "\uFFFD";
            else
                out += c;
        }
    return out;
}

std::string relative_url(std::string_view path) {
    constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string out;
    for (char const c : path) {
        auto const byte = static_cast<unsigned char>(c);
        if (plain.find(c) != std::string_view::npos)
            out += c;
        else
            out += {'%', digits[byte >> 4U], digits[byte & 15U]};
    }
    return out;
}

std::string shortened(std::string_view text, std::size_t most) {
    auto const characters = static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return !is_continuation(c); }));
    if (characters <= most)
        return std::string(text);
    std::size_t end = 0;
    for (std::size_t kept = 0; end < text.size(); ++end)
        if (!is_continuation(text[end]) && ++kept == most)
            break;
    return std::string(text.substr(0, end)) + "…";
}

std::string figure(double value, int digits) {
    if (!std::isfinite(value))
        return "not finite";
    std::string const number = printed("%.*g", digits, value == 0.0 ? 0.0 : value);
    auto const e = number.find('e');
    if (e == std::string::npos)
        return with_true_minus(number);
    std::string exponent = number.substr(e + 1);
    bool const negative = exponent.front() == '-';
    exponent.erase(0, exponent.find_first_of("123456789"));
    std::string const mantissa = number.substr(0, e);
    return (mantissa == "1" ? "10<sup>" : with_true_minus(mantissa) + "×10<sup>") + (negative ? "−" : "") +
           exponent + "</sup>";
}

std::string count(std::uint64_t value) {
    std::string const digits = std::to_string(value);
    std::string out;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0)
            out += "\u202F"; // narrow no-break space
        out += digits[i];
    }
    return out;
}

std::string per_cent(double share) {
    return figure(100.0 * share, 4) + " %";
}

std::string coordinate(double pixels) {
    std::string number = printed("%.*f", 2, pixels);
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.')
        number.pop_back();
    return number == "-0" ? "0" : number;
}

Value const* at(Value const& value, std::initializer_list<std::string_view> path) {
    Value const* here = &value;
    for (std::string_view const key : path)
        if (here = here->find(key); !here)
            return nullptr;
    return std::holds_alternative<std::monostate>(here->data) ? nullptr : here;
}

namespace {

std::optional<double> as_number(Value const& value) {
    if (auto const* real = std::get_if<double>(&value.data))
        return std::isfinite(*real) ? std::optional(*real) : std::nullopt;
    if (auto const* integer = std::get_if<std::int64_t>(&value.data))
        return static_cast<double>(*integer);
    return std::nullopt;
}

std::string own_name(Value const& entry, std::size_t number) {
    for (std::string_view const key : {"name", "wavelength_nm", "source", "object"}) {
        if (auto const text = text_at(entry, {key}))
            return *text;
        if (auto const value = number_at(entry, {key}))
            return printed("%.*g", 10, *value);
    }
    return std::to_string(number);
}

} // namespace

std::optional<double> number_at(Value const& value, std::initializer_list<std::string_view> path) {
    Value const* const found = at(value, path);
    return found ? as_number(*found) : std::nullopt;
}

std::optional<std::string> text_at(Value const& value, std::initializer_list<std::string_view> path) {
    Value const* const found = at(value, path);
    auto const* text = found ? std::get_if<std::string>(&found->data) : nullptr;
    return text ? std::optional(*text) : std::nullopt;
}

std::optional<std::vector<double>> numbers_at(Value const& value,
                                              std::initializer_list<std::string_view> path) {
    Value const* const found = at(value, path);
    auto const* list = found ? std::get_if<Array>(&found->data) : nullptr;
    if (!list || list->empty())
        return std::nullopt;
    std::vector<double> numbers;
    for (Value const& entry : *list) {
        auto const number = as_number(entry);
        if (!number)
            return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers;
}

std::vector<std::pair<std::string, Value const*>> entries_at(Value const& value, std::string_view key) {
    std::vector<std::pair<std::string, Value const*>> entries;
    Value const* const found = at(value, {key});
    if (!found)
        return entries;
    if (auto const* table = std::get_if<Table>(&found->data))
        for (auto const& [name, entry] : *table)
            entries.emplace_back(name, &entry);
    else if (auto const* list = std::get_if<Array>(&found->data))
        for (Value const& entry : *list)
            entries.emplace_back(own_name(entry, entries.size()), &entry);
    return entries;
}

std::string shown(Value const* value) {
    if (!value)
        return "–";
    if (auto const* whole = std::get_if<std::int64_t>(&value->data); whole && *whole >= 0)
        return count(static_cast<std::uint64_t>(*whole));
    if (auto const number = as_number(*value))
        return figure(*number);
    if (auto const* text = std::get_if<std::string>(&value->data))
        return escaped(*text);
    if (auto const* truth = std::get_if<bool>(&value->data))
        return *truth ? "yes" : "no";
    auto const* list = std::get_if<Array>(&value->data);
    if (!list || list->empty())
        return "–";
    std::string out;
    for (Value const& entry : *list) {
        auto const part = as_number(entry);
        bool const rounding = part && std::abs(*part) < least_part;
        out += (out.empty() ? "(" : ", ") + (rounding ? "0" : shown(&entry));
    }
    return out + ")";
}

std::string html_of(HtmlTable const& table) {
    std::string out = "<div class=\"scroll\"><table><thead><tr>";
    for (std::string const& heading : table.headings)
        out += "<th>" + heading + "</th>";
    out += "</tr></thead><tbody>\n";
    for (auto const& row : table.rows) {
        out += "<tr>";
        for (std::string const& cell : row)
            out += "<td>" + cell + "</td>";
        out += "</tr>\n";
    }
    return out + "</tbody></table></div>\n";
}

} // namespace sahl::report

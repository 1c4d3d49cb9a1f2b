// In: text of a catalogue. Out: lines, words, numbers.
#include "materials/text_lines.h"

#include "math/input_error.h"

#include <charconv>
#include <cmath>

namespace sahl {

std::vector<TextLine> lines_of(std::string_view text) {
    std::vector<TextLine> lines;
    for (int number = 1; !text.empty(); ++number) {
        auto const end = text.find('\n');
        std::string_view line = text.substr(0, end);
        text.remove_prefix(end == text.npos ? text.size() : end + 1);
        if (line.ends_with('\r'))
            line.remove_suffix(1);
        lines.push_back({number, line});
    }
    return lines;
}

std::vector<std::string_view> words_of(std::string_view line) {
    constexpr std::string_view blanks = " \t\r\v\f";
    std::vector<std::string_view> words;
    while (true) {
        auto const start = line.find_first_not_of(blanks);
        if (start == line.npos)
            return words;
        line.remove_prefix(start);
        auto const end = line.find_first_of(blanks);
        words.push_back(line.substr(0, end));
        line.remove_prefix(end == line.npos ? line.size() : end);
    }
}

std::optional<double> number_of(std::string_view word) {
    if (word.starts_with('+') && word.size() > 1 && word[1] != '-')
        word.remove_prefix(1);
    double value = 0.0;
    auto const [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    bool const whole = error == std::errc() && end == word.data() + word.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::vector<double> numbers_of(std::vector<std::string_view> const& words, std::string const& place) {
    std::vector<double> numbers;
    for (std::string_view const word : words) {
        auto const number = number_of(word);
        if (!number)
            throw InputError(place, "\"" + std::string(word.substr(0, 40)) + "\" is not a finite number",
                             "write it like 1.5 or 1.5E-3");
        numbers.push_back(*number);
    }
    return numbers;
}

std::string place_of(std::string const& file, TextLine const& line) {
    return file + ":" + std::to_string(line.number);
}

std::string without_byte_order(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF"))
        return std::string(text.substr(3));
    // ASCII in UTF-16 has a zero in each pair, with or without a mark before it
    bool const marked = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
    bool const little = text.starts_with("\xFF\xFE") || (text.size() > 1 && text[0] != 0 && text[1] == 0);
    bool const big = text.starts_with("\xFE\xFF") || (text.size() > 1 && text[0] == 0 && text[1] != 0);
    if (!little && !big)
        return std::string(text);
    std::string bytes;
    for (std::size_t i = marked ? 2 : 0; i + 1 < text.size(); i += 2) {
        char const low = text[i + (little ? 0 : 1)], high = text[i + (little ? 1 : 0)];
        bytes += high == 0 && static_cast<unsigned char>(low) < 128 ? low : '?';
    }
    return bytes;
}

} // namespace sahl

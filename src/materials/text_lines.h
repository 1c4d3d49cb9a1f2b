// In: text. Out: its lines, their words, and numbers that are certainly numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sahl {

struct TextLine {
    int number = 0; // from 1
    std::string_view text;
};

/// Lines without their ends, be these LF or CR LF.
std::vector<TextLine> lines_of(std::string_view text);

/// What stands between blanks.
std::vector<std::string_view> words_of(std::string_view line);

/// The whole word as a finite number, "+1.5" and "1.5E-03" among them. Nothing for anything else, NaN,
/// infinity, or a number too large for a double.
std::optional<double> number_of(std::string_view word);

/// The numbers of a line. Throws InputError, with the file and the line, at the first word that is none.
std::vector<double> numbers_of(std::vector<std::string_view> const& words, std::string const& place);

/// "file:12"
std::string place_of(std::string const& file, TextLine const& line);

/// Text in UTF-16 with a byte order mark becomes bytes, '?' for what ASCII has not; a mark of UTF-8 is
/// dropped; other text stays as it is.
std::string without_byte_order(std::string_view text);

} // namespace sahl

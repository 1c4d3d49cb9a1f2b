// In: the text of an OBJ or MTL file. Out: its lines, word by word, and numbers, or an InputError with the
// line.
#pragma once

#include "math/input_error.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

namespace sahl {

/// A backslash before the end of a line continues it; a word that begins with # ends it.
class ObjLines {
  public:
    ObjLines(std::string_view text, std::string file)
        : at_(text.data()), end_(at_ + text.size()), file_(std::move(file)) {
        if (text.substr(0, 3) == "\xEF\xBB\xBF") // a byte order mark
            at_ += 3;
    }

    /// Goes to the next line; false at the end of the text.
    bool next_line() {
        while (started_ && at_ != end_ && *at_ != '\n' && *at_ != '\r')
            step();
        if (started_ && at_ != end_)
            end_line();
        started_ = true;
        return at_ != end_;
    }

    /// The next word of this line; empty where there is none.
    std::string_view word() {
        while (at_ != end_ && is_blank())
            step();
        char const* const begin = at_;
        if (at_ != end_ && *at_ == '#')
            return {};
        while (at_ != end_ && !is_blank() && *at_ != '\n' && *at_ != '\r')
            ++at_;
        return {begin, static_cast<std::size_t>(at_ - begin)};
    }

    /// All that is left of this line, # and blanks within it too: a name.
    std::string_view rest() {
        while (at_ != end_ && is_blank())
            step();
        char const* const begin = at_;
        while (at_ != end_ && *at_ != '\n' && *at_ != '\r')
            ++at_;
        char const* last = at_;
        while (last != begin && (last[-1] == ' ' || last[-1] == '\t'))
            --last;
        return {begin, static_cast<std::size_t>(last - begin)};
    }

    std::uint64_t line() const { return line_; }
    std::string place() const { return file_ + ":" + std::to_string(line_); }

  private:
    bool continues() const { return *at_ == '\\' && (at_ + 1 == end_ || at_[1] == '\n' || at_[1] == '\r'); }
    bool is_blank() const { return *at_ == ' ' || *at_ == '\t' || continues(); }
    void end_line() {
        at_ += at_ + 1 != end_ && at_[0] == '\r' && at_[1] == '\n' ? 2 : 1;
        ++line_;
    }
    void step() {
        bool const next = continues();
        ++at_;
        if (next && at_ != end_)
            end_line();
    }

    char const* at_;
    char const* end_;
    std::string file_;
    std::uint64_t line_ = 1;
    bool started_ = false;
};

/// A word as a message shows it: short, and without bytes that a terminal would obey.
inline std::string shown(std::string_view word) {
    std::string text(word.substr(0, 40));
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 32 || c == 127)
            c = '?';
    return "'" + text + (word.size() > 40 ? "…'" : "'");
}

/// A finite number, or nothing. One too small for a double is 0.
inline bool read_number(std::string_view word, double& number) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-')
        word.remove_prefix(1);
    auto const [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error == std::errc::result_out_of_range && end == word.data() + word.size() &&
        (word.find("e-") != word.npos || word.find("E-") != word.npos)) {
        number = 0.0;
        return true;
    }
    return error == std::errc() && end == word.data() + word.size() && std::isfinite(number);
}

} // namespace sahl

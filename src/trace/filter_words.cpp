#include "trace/filter_words.h"

#include "math/input_error.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr std::string_view symbols = "()[],<>=!";

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_quote(char c) {
    return c == '"' || c == '\'';
}

bool ends_word(char c) {
    return is_blank(c) || is_quote(c) || symbols.find(c) != symbols.npos;
}

/// Bytes of UTF-8 that begin a character.
std::size_t characters(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

} // namespace

void refuse_filter(std::string_view text, std::string const& place, FilterSpan span,
                   std::string const& problem, std::string const& remedy) {
    std::string shown(text);
    std::replace_if(shown.begin(), shown.end(), is_blank, ' '); // one line, and columns stay
    std::string const mark(std::max<std::size_t>(1, characters(text.substr(span.at, span.length))), '^');
    throw InputError(place, problem,
                     remedy + "\n    " + shown + "\n    " +
                         std::string(characters(text.substr(0, span.at)), ' ') + mark);
}

std::string as_filter_name(std::string const& name) {
    bool const plain = !name.empty() && std::none_of(name.begin(), name.end(), [](char c) {
        return ends_word(c) || c == '*' || c == '?' || c == '\\' || static_cast<unsigned char>(c) < 0x20U;
    });
    if (plain)
        return name;
    std::string quoted = "\"";
    for (char const c : name)
        quoted.append(c == '"' || c == '\\' ? "\\" : "") += c;
    return quoted + '"';
}

std::vector<FilterWord> filter_words(std::string_view text, std::string const& place) {
    using Kind = FilterWord::Kind;
    std::vector<FilterWord> words;
    std::size_t at = 0;
    while (at < text.size()) {
        std::size_t const start = at;
        char const c = text[at];
        if (is_blank(c)) {
            ++at;
        } else if (is_quote(c)) {
            std::string name;
            for (++at; at < text.size() && text[at] != c; ++at) {
                at += text[at] == '\\' && at + 1 < text.size() ? 1 : 0;
                name += text[at];
            }
            if (at >= text.size())
                refuse_filter(text, place, {start, text.size() - start}, "these quotes are not closed",
                              std::string("close them with ") + c);
            ++at;
            words.push_back({Kind::quoted, name, {start, at - start}});
        } else if (symbols.find(c) != symbols.npos) {
            bool const two =
                (c == '<' || c == '>' || c == '!' || c == '=') && at + 1 < text.size() && text[at + 1] == '=';
            at += two ? 2 : 1;
            words.push_back({Kind::symbol, std::string(text.substr(start, at - start)), {start, at - start}});
        } else {
            while (at < text.size() && !ends_word(text[at]))
                ++at;
            words.push_back({Kind::word, std::string(text.substr(start, at - start)), {start, at - start}});
        }
    }
    words.push_back({Kind::end, "", {text.size(), 1}});
    return words;
}

} // namespace sahl

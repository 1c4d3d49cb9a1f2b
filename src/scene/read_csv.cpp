// In: a CSV file. Out: its rows of numbers.
#include "scene/read_sources.h"

#include "math/input_error.h"
#include "scene/read_file.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace sahl {

namespace {

std::string_view trimmed(std::string_view text) {
    auto const first = text.find_first_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t start = 0; start <= text.size();) {
        auto const end = std::min(text.find(separator, start), text.size());
        parts.push_back(trimmed(text.substr(start, end - start)));
        start = end + 1;
    }
    return parts;
}

bool to_number(std::string_view text, double& number) {
    if (!text.empty() && text.front() == '+')
        text.remove_prefix(1);
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

} // namespace

void read_csv(std::filesystem::path const& path, std::string const& columns,
              bool (*is_header)(std::vector<std::string_view> const&),
              std::function<void(CsvRow const&)> const& take) {
    std::string const text = file_text(path);
    CsvRow row;
    std::size_t line_number = 0;
    bool header_may_follow = true;
    for (std::size_t start = 0; start < text.size();) {
        auto const end = std::min(text.find('\n', start), text.size());
        auto const line = trimmed(std::string_view(text).substr(start, end - start));
        start = end + 1;
        ++line_number;
        if (line.empty() || line.front() == '#')
            continue;
        auto const fields = split(line, ',');
        if (std::exchange(header_may_follow, false) && is_header(fields))
            continue;
        row.place = path.string() + ":" + std::to_string(line_number);
        row.numbers.clear();
        for (auto const field : fields)
            if (!to_number(field, row.numbers.emplace_back()))
                throw InputError(row.place, "\"" + std::string(field) + "\" is no number", "give " + columns);
        take(row);
    }
}

} // namespace sahl

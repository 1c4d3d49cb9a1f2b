#include "run/sweep_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace sahl {

namespace {

double number_of(Value const& value) {
    if (auto const* const integer = std::get_if<std::int64_t>(&value.data))
        return static_cast<double>(*integer);
    auto const* const real = std::get_if<double>(&value.data);
    return real ? *real : NAN;
}

bool is_time(std::string const& key) {
    return key == "seconds" || key == "segments_per_second" || key == "threads";
}

/// All numbers of a summary under the path that leads to them; what is null in one run is NaN there.
void flatten(Value const& value, std::string const& path, std::vector<std::pair<std::string, double>>& out) {
    if (auto const* const table = std::get_if<Table>(&value.data)) {
        for (auto const& [key, entry] : *table)
            if (!is_time(key) && key != "options" && key != "seed" && key != "models" && key != "lost_rays")
                flatten(entry, path.empty() ? key : path + "." + key, out);
    } else if (auto const* const array = std::get_if<Array>(&value.data)) {
        for (std::size_t i = 0; i < array->size(); ++i)
            flatten((*array)[i], path + "[" + std::to_string(i) + "]", out);
    } else if (value.is_number()) {
        out.emplace_back(path, number_of(value));
    }
}

std::string text_of(double x) {
    char text[40];
    return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

std::string quoted(std::string const& text) {
    if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
    std::string result = "\"";
    for (char const c : text)
        result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

/// Adds the numbers of `addend` to the equally named ones of `sum`.
void add_numbers(Value& sum, Value const& addend) {
    if (auto* const table = std::get_if<Table>(&sum.data)) {
        for (auto& [key, entry] : *table)
            if (Value const* const other = addend.find(key))
                add_numbers(entry, *other);
    } else if (auto* const integer = std::get_if<std::int64_t>(&sum.data)) {
        *integer += static_cast<std::int64_t>(number_of(addend));
    } else if (auto* const real = std::get_if<double>(&sum.data)) {
        *real += number_of(addend);
    }
}

} // namespace

std::string sweep_csv(std::string const& key, std::vector<SweepRow> const& rows) {
    std::vector<std::string> columns;
    std::vector<std::vector<std::pair<std::string, double>>> cells;
    for (SweepRow const& row : rows) {
        flatten(row.summary, "", cells.emplace_back());
        for (auto const& [name, value] : cells.back())
            if (std::find(columns.begin(), columns.end(), name) == columns.end())
                columns.push_back(name);
    }
    std::string csv = quoted(key);
    for (std::string const& column : columns)
        csv += "," + quoted(column);
    csv += "\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        csv += text_of(rows[i].value);
        for (std::string const& column : columns) {
            auto const cell = std::find_if(cells[i].begin(), cells[i].end(),
                                           [&](auto const& c) { return c.first == column; });
            csv += "," + (cell == cells[i].end() ? std::string() : text_of(cell->second));
        }
        csv += "\n";
    }
    return csv;
}

Value sweep_summary(std::string const& key, std::vector<SweepRow> const& rows,
                    std::vector<std::string> const& set, std::vector<std::string> const& failures) {
    Table summary;
    auto const text_list = [](std::vector<std::string> const& list) {
        Array array;
        for (std::string const& text : list)
            array.push_back({text, {}});
        return Value{std::move(array), {}};
    };
    Value const& first = rows.front().summary;
    for (char const* same : {"title", "program", "experiment_sha256", "seed", "options"})
        summary.emplace_back(same, *first.find(same));
    if (Value* const options = &summary.back().second; Value* const settings = options->find("set"))
        *settings = text_list(set); // the sweep's own key apart
    summary.emplace_back("passed", Value{failures.empty(), {}});
    summary.emplace_back("failures", text_list(failures));
    for (char const* added : {"rays", "segments", "seconds"}) {
        Value sum = *first.find(added);
        for (std::size_t i = 1; i < rows.size(); ++i)
            add_numbers(sum, *rows[i].summary.find(added));
        summary.emplace_back(added, std::move(sum));
    }
    double const seconds = number_of(summary.back().second);
    summary.emplace_back("segments_per_second",
                         Value{number_of(summary[summary.size() - 2].second) / std::max(seconds, 1e-9), {}});
    summary.emplace_back("threads", *first.find("threads"));
    for (char const* added : {"energy_W", "events"}) {
        Value sum = *first.find(added);
        for (std::size_t i = 1; i < rows.size(); ++i)
            add_numbers(sum, *rows[i].summary.find(added));
        summary.emplace_back(added, std::move(sum));
    }
    Array runs;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        char folder[32];
        std::snprintf(folder, sizeof folder, "runs/%03zu", i);
        runs.push_back({Table{{"value", {rows[i].value, {}}}, {"folder", {std::string(folder), {}}}}, {}});
    }
    summary.emplace_back("sweep", Value{Table{{"key", {key, {}}}, {"runs", {std::move(runs), {}}}}, {}});
    summary.emplace_back("warnings", *first.find("warnings"));
    return {std::move(summary), {}};
}

} // namespace sahl

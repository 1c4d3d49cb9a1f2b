#include "run/sweep_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>

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
void flatten(Value const& value, std::string const& path, Figures& out) {
    if (auto const* const table = std::get_if<Table>(&value.data)) {
        for (auto const& [key, entry] : *table)
            if (!is_time(key) && key != "options" && key != "seed" && key != "models" && key != "lost_rays" &&
                key != "pilots")
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

std::string csv_text(std::string const& text) {
    if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
    std::string result = "\"";
    for (char const c : text)
        result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

std::string cell_of(Value const& value) {
    if (value.is_number())
        return text_of(number_of(value));
    auto const* text = std::get_if<std::string>(&value.data);
    return csv_text(text ? *text : to_json(value));
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

std::string run_name(std::size_t run) {
    char name[32];
    std::snprintf(name, sizeof name, "%03zu", run);
    return name;
}

Figures figures_of(Value const& summary) {
    Figures figures;
    flatten(summary, "", figures);
    return figures;
}

std::string sweep_csv(std::vector<std::string> const& keys, std::vector<SweepRow> const& rows) {
    std::map<std::string, std::size_t> columns;
    std::vector<std::string> names;
    std::vector<Figures> figures;
    for (SweepRow const& row : rows) {
        figures.push_back(figures_of(row.summary));
        for (auto const& [name, value] : figures.back())
            if (columns.emplace(name, names.size()).second)
                names.push_back(name);
    }
    std::string csv;
    for (std::string const& key : keys)
        csv += csv_text(key) + ",";
    for (std::size_t i = 0; i < names.size(); ++i)
        csv += (i == 0 ? "" : ",") + csv_text(names[i]);
    csv += "\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::vector<std::string> cells(names.size());
        for (auto const& [name, value] : figures[i])
            cells[columns[name]] = text_of(value);
        for (Value const& value : rows[i].values)
            csv += cell_of(value) + ",";
        for (std::size_t c = 0; c < cells.size(); ++c)
            csv += (c == 0 ? "" : ",") + cells[c];
        csv += "\n";
    }
    return csv;
}

Value sweep_summary(std::vector<std::string> const& keys, std::vector<SweepRow> const& rows,
                    std::vector<std::string> const& set, std::vector<std::string> const& failures,
                    SweepTime const& time) {
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
    for (char const* added : {"rays", "segments"}) {
        Value sum = *first.find(added);
        for (std::size_t i = 1; i < rows.size(); ++i)
            add_numbers(sum, *rows[i].summary.find(added));
        summary.emplace_back(added, std::move(sum));
    }
    summary.emplace_back("seconds", Value{time.seconds, {}});
    double segments = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (!time.kept[i])
            segments += number_of(*rows[i].summary.find("segments"));
    summary.emplace_back("segments_per_second", Value{segments / std::max(time.seconds, 1e-9), {}});
    summary.emplace_back("threads", *first.find("threads"));
    for (char const* added : {"energy_W", "events"}) {
        Value sum = *first.find(added);
        for (std::size_t i = 1; i < rows.size(); ++i)
            add_numbers(sum, *rows[i].summary.find(added));
        summary.emplace_back(added, std::move(sum));
    }
    Array names, runs;
    for (std::string const& key : keys)
        names.push_back({key, {}});
    for (std::size_t i = 0; i < rows.size(); ++i)
        runs.push_back(
            {Table{{"values", {Array(rows[i].values), {}}}, {"folder", {"runs/" + run_name(i), {}}}}, {}});
    summary.emplace_back("sweep",
                         Value{Table{{"keys", {std::move(names), {}}}, {"runs", {std::move(runs), {}}}}, {}});
    summary.emplace_back("warnings", *first.find("warnings"));
    return {std::move(summary), {}};
}

} // namespace sahl

// In: the text of a JSON file, or a tree of values. Out: the tree with JSON pointers, or the text.
// The only door to nlohmann-json.
#include "math/input_error.h"
#include "scene/value.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace sahl {

namespace {

using Json = nlohmann::json;

constexpr int deepest = 256;

/// Line and column, from 1, of the byte at `offset`.
Place place_at(std::string_view text, std::size_t offset, std::string const& file) {
    std::string_view const before = text.substr(0, offset);
    auto const line_start = before.rfind('\n');
    auto const column = line_start == std::string_view::npos ? before.size() : before.size() - line_start - 1;
    return {file,
            static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
            static_cast<int>(column) + 1,
            {}};
}

void refuse_deep_nesting(std::string_view text, std::string const& file) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        char const c = text[i];
        if (in_string && c == '\\')
            ++i;
        else if (c == '"')
            in_string = !in_string;
        else if (!in_string && (c == '[' || c == '{') && ++depth > deepest)
            throw InputError(place_at(text, i, file).text(), "more than 256 levels of brackets",
                             "nest less deeply");
        else if (!in_string && (c == ']' || c == '}'))
            --depth;
    }
}

std::string pointer_token(std::string const& key) {
    std::string token = "/";
    for (char const c : key)
        token += c == '~' ? std::string("~0") : c == '/' ? std::string("~1") : std::string(1, c);
    return token;
}

/// Builds the tree from the parser's events, so that duplicate keys are seen and every value knows its
/// pointer.
class Builder : public nlohmann::json_sax<Json> {
  public:
    Builder(std::string_view text, std::string const& file) : text_(text), file_(file) {}

    bool null() override { return take(std::monostate{}); }
    bool boolean(bool value) override { return take(value); }
    bool number_integer(std::int64_t value) override { return take(value); }
    bool number_unsigned(std::uint64_t value) override {
        if (value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
            return take(static_cast<std::int64_t>(value));
        return take(static_cast<double>(value));
    }
    bool number_float(double value, std::string const&) override { return take(value); }
    bool string(std::string& value) override { return take(std::move(value)); }
    bool binary(Json::binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(Table{}); }
    bool start_array(std::size_t) override { return open(Array{}); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(std::string& name) override {
        Level& level = levels_.back();
        if (!level.keys.insert(name).second)
            throw InputError(file_ + ": " + level.value.place.pointer + pointer_token(name),
                             "this key stands here twice", "keep one of the two");
        level.next_key = name;
        return true;
    }
    bool parse_error(std::size_t position, std::string const&, Json::exception const& error) override {
        std::string const what = error.what(); // "[…] parse error at line 1, column 5: what we want"
        auto const end_of_place = what.find(": ");
        auto const end_of_tag = what.find("] ");
        auto const start = end_of_place != std::string::npos ? end_of_place : end_of_tag;
        throw InputError(place_at(text_, position == 0 ? 0 : position - 1, file_).text(),
                         start == std::string::npos ? what : what.substr(start + 2),
                         "mend the JSON there, or just before");
    }

    Value root;

  private:
    struct Level {
        Value value;
        std::string next_key;
        std::unordered_set<std::string> keys;
    };

    Place next_place() const {
        if (levels_.empty())
            return {file_, 0, 0, {}};
        Level const& level = levels_.back();
        auto const* array = std::get_if<Array>(&level.value.data);
        return {file_, 0, 0,
                level.value.place.pointer +
                    (array ? "/" + std::to_string(array->size()) : pointer_token(level.next_key))};
    }
    bool put(Value value) {
        if (levels_.empty())
            root = std::move(value);
        else if (auto* array = std::get_if<Array>(&levels_.back().value.data))
            array->push_back(std::move(value));
        else
            std::get<Table>(levels_.back().value.data)
                .emplace_back(levels_.back().next_key, std::move(value));
        return true;
    }
    template <class Data>
    bool take(Data data) {
        return put({std::move(data), next_place()});
    }
    template <class Data>
    bool open(Data data) {
        levels_.push_back({{std::move(data), next_place()}, {}, {}});
        return true;
    }
    bool close() {
        Value value = std::move(levels_.back().value);
        levels_.pop_back();
        return put(std::move(value));
    }

    std::string_view text_;
    std::string const& file_;
    std::vector<Level> levels_;
};

std::string quoted(std::string const& text) {
    return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string number(double value) {
    if (!std::isfinite(value))
        return "null";
    char buffer[32];
    auto const end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    std::string const text(buffer, end);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

bool is_container(Value const& value) {
    return std::holds_alternative<Array>(value.data) || std::holds_alternative<Table>(value.data);
}

void write(Value const& value, std::size_t level, std::string& out);

/// Lists of plain values stand on one line, all else one entry a line.
void write_array(Array const& array, std::size_t level, std::string& out) {
    bool const on_one_line = std::none_of(array.begin(), array.end(), is_container);
    std::string const indent = on_one_line ? std::string() : "\n" + std::string(2 * level + 2, ' ');
    out += '[';
    for (std::size_t i = 0; i < array.size(); ++i) {
        out += i == 0 ? "" : on_one_line ? ", " : ",";
        out += indent;
        write(array[i], level + 1, out);
    }
    out += on_one_line ? "]" : "\n" + std::string(2 * level, ' ') + "]";
}

void write_table(Table const& table, std::size_t level, std::string& out) {
    out += '{';
    for (std::size_t i = 0; i < table.size(); ++i) {
        out += (i == 0 ? "\n" : ",\n") + std::string(2 * level + 2, ' ') + quoted(table[i].first) + ": ";
        write(table[i].second, level + 1, out);
    }
    out += table.empty() ? "}" : "\n" + std::string(2 * level, ' ') + "}";
}

void write(Value const& value, std::size_t level, std::string& out) {
    if (auto const* array = std::get_if<Array>(&value.data))
        write_array(*array, level, out);
    else if (auto const* table = std::get_if<Table>(&value.data))
        write_table(*table, level, out);
    else if (auto const* text = std::get_if<std::string>(&value.data))
        out += quoted(*text);
    else if (auto const* real = std::get_if<double>(&value.data))
        out += number(*real);
    else if (auto const* integer = std::get_if<std::int64_t>(&value.data))
        out += std::to_string(*integer);
    else if (auto const* truth = std::get_if<bool>(&value.data))
        out += *truth ? "true" : "false";
    else
        out += "null";
}

} // namespace

Value parse_json(std::string_view text, std::string const& file) {
    refuse_deep_nesting(text, file);
    Builder builder(text, file);
    Json::sax_parse(text.begin(), text.end(), &builder);
    return std::move(builder.root);
}

std::string to_json(Value const& value) {
    std::string out;
    write(value, 0, out);
    return out;
}

} // namespace sahl

// In: a table of an experiment file and the declaration of its keys. Out: its values, or the first thing
// wrong with them.
#include "scene/read_table.h"

#include "math/input_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sahl {

namespace {

/// Items of a list of numbers by its kind; 0: any number of them; −1: this kind is no such list.
int list_size(Kind kind) {
    switch (kind) {
    case Kind::numbers:
        return 0;
    case Kind::two:
        return 2;
    case Kind::three:
        return 3;
    case Kind::four:
        return 4;
    case Kind::sixteen:
        return 16;
    default:
        return -1;
    }
}

bool in_range(double x, Range const& range) {
    return std::isfinite(x) && x >= range.low && x <= range.high && !(range.above && x == range.low);
}

bool is_list_of(Value const& value, bool (*fits)(Value const&)) {
    auto const* array = std::get_if<Array>(&value.data);
    return array && std::all_of(array->begin(), array->end(), fits);
}

bool is_number(Value const& value) {
    return value.is_number();
}
bool is_text(Value const& value) {
    return std::holds_alternative<std::string>(value.data);
}
bool is_table(Value const& value) {
    return std::holds_alternative<Table>(value.data);
}
bool is_pair(Value const& value) {
    return is_list_of(value, is_number) && std::get<Array>(value.data).size() == 2 &&
           is_list_of(value, [](Value const& item) { return std::isfinite(number_in(item)); });
}

/// The first number of a value that is out of the key's range, or nullptr.
Value const* out_of_range(Value const& value, Key const& key) {
    if (key.kind == Kind::number || key.kind == Kind::integer)
        return in_range(number_in(value), key.range) ? nullptr : &value;
    if (list_size(key.kind) < 0)
        return nullptr;
    auto const& items = std::get<Array>(value.data);
    auto const bad = std::find_if(items.begin(), items.end(),
                                  [&](Value const& item) { return !in_range(number_in(item), key.range); });
    return bad == items.end() ? nullptr : &*bad;
}

} // namespace

bool has_kind(Value const& value, Kind kind) {
    switch (kind) {
    case Kind::truth:
        return std::holds_alternative<bool>(value.data);
    case Kind::integer:
        return value.is_number() && number_in(value) == std::floor(number_in(value));
    case Kind::number:
        return value.is_number();
    case Kind::text:
        return is_text(value);
    case Kind::pairs:
        return is_list_of(value, is_pair);
    case Kind::texts:
        return is_list_of(value, is_text);
    case Kind::table:
        return is_table(value);
    case Kind::tables:
        return is_list_of(value, is_table);
    case Kind::any:
        return true;
    default: {
        auto const size = static_cast<std::size_t>(list_size(kind));
        return is_list_of(value, is_number) && (size == 0 || std::get<Array>(value.data).size() == size);
    }
    }
}

Fields::Fields(Value const& table, KeyTable const& declared) : table_(table), declared_(declared) {
    std::string const title(declared.title);
    auto const* entries = std::get_if<Table>(&table.data);
    if (!entries)
        throw InputError(table.place.text(), title + " is " + quoted_value(table), "give a table of keys");
    std::vector<std::string> known;
    for (Key const& key : declared.keys)
        known.emplace_back(key.name);
    for (auto const& [name, value] : *entries) {
        auto const key = std::find_if(declared.keys.begin(), declared.keys.end(),
                                      [&name = name](Key const& k) { return k.name == name; });
        if (key == declared.keys.end())
            throw InputError(value.place.text(), "unknown key '" + name + "' in " + title,
                             known.empty() ? "it has no keys" : did_you_mean(name, known));
        if (!has_kind(value, key->kind))
            throw InputError(value.place.text(), called(name) + " is " + quoted_value(value),
                             "give " + expected(*key));
        if (Value const* bad = out_of_range(value, *key))
            throw InputError(bad->place.text(),
                             called(name) + (bad == &value ? " is " : " holds ") + quoted_value(*bad),
                             "give " + expected(*key));
    }
    for (Key const& key : declared.keys)
        if (std::holds_alternative<Required>(key.fallback) && !has(key.name))
            throw InputError(table.place.text(), "'" + std::string(key.name) + "' is missing in " + title,
                             "give " + std::string(key.name) + " = " + expected(key));
}

Value const& Fields::at(std::string_view key) const {
    Value const* value = table_.find(key);
    assert(value);
    return *value;
}

Key const& Fields::declaration(std::string_view key) const {
    auto const found = std::find_if(declared_.keys.begin(), declared_.keys.end(),
                                    [&](Key const& k) { return k.name == key; });
    assert(found != declared_.keys.end());
    return *found;
}

bool Fields::truth(std::string_view key) const {
    return has(key) ? std::get<bool>(at(key).data) : std::get<bool>(declaration(key).fallback);
}

double Fields::number(std::string_view key) const {
    return has(key) ? number_in(at(key)) : std::get<double>(declaration(key).fallback);
}

std::int64_t Fields::integer(std::string_view key) const {
    if (has(key))
        if (auto const* whole = std::get_if<std::int64_t>(&at(key).data))
            return *whole;
    return static_cast<std::int64_t>(number(key));
}

std::string Fields::text(std::string_view key) const {
    return has(key) ? std::get<std::string>(at(key).data)
                    : std::string(std::get<std::string_view>(declaration(key).fallback));
}

std::vector<double> Fields::numbers(std::string_view key) const {
    if (has(key))
        return numbers_in(std::get<Array>(at(key).data));
    auto const* repeated = std::get_if<Repeated>(&declaration(key).fallback);
    return repeated ? std::vector<double>(static_cast<std::size_t>(repeated->count), repeated->value)
                    : std::vector<double>();
}

std::string Fields::called(std::string_view key) const {
    return "'" + std::string(key) + "' in " + std::string(declared_.title);
}

std::string Fields::only_one_of(std::initializer_list<std::string_view> keys) const {
    std::vector<std::string> found;
    for (auto const key : keys)
        if (has(key))
            found.emplace_back(key);
    if (found.size() == 1)
        return found.front();
    std::string const title(declared_.title);
    std::string const remedy = "give exactly one of " + listed({keys.begin(), keys.end()});
    if (found.empty())
        throw InputError(place().text(), title + " does not say what it is", remedy);
    throw InputError(place(found.back()).text(), title + " has " + listed(found) + " at once", remedy);
}

void Fields::refuse_choice(std::string_view key, std::vector<std::string> const& names) const {
    throw InputError(place(key).text(), called(key) + " is \"" + text(key) + "\"",
                     did_you_mean(text(key), names) + " There are " + listed(names));
}

double number_in(Value const& value) {
    auto const* whole = std::get_if<std::int64_t>(&value.data);
    return whole ? static_cast<double>(*whole) : std::get<double>(value.data);
}

std::vector<double> numbers_in(Array const& array) {
    std::vector<double> numbers;
    for (Value const& item : array)
        numbers.push_back(number_in(item));
    return numbers;
}

std::vector<std::pair<double, double>> ascending_pairs(Value const& list) {
    std::vector<std::pair<double, double>> pairs;
    for (Value const& row : std::get<Array>(list.data)) {
        auto const numbers = numbers_in(std::get<Array>(row.data));
        if (!pairs.empty() && numbers[0] <= pairs.back().first)
            throw InputError(row.place.text(), "the first numbers of this list do not ascend",
                             "sort its rows, without repeats");
        pairs.emplace_back(numbers[0], numbers[1]);
    }
    return pairs;
}

std::string quoted_value(Value const& value) {
    if (std::holds_alternative<Table>(value.data))
        return "a table";
    if (auto const* array = std::get_if<Array>(&value.data))
        return "a list of " + std::to_string(array->size());
    if (auto const* real = std::get_if<double>(&value.data); real && !std::isfinite(*real))
        return std::isnan(*real) ? "not a number (nan)" : "infinite";
    return to_json(value);
}

Array const& tables_in(Value const& tree, std::string_view key) {
    static Array const none;
    Value const* list = tree.find(key);
    return list ? std::get<Array>(list->data) : none;
}

} // namespace sahl

// In: a tree of values and a key such as object.prism.turn_deg[2]. Out: the tree with that key set.
#include "math/input_error.h"
#include "scene/read_experiment.h"
#include "scene/read_table.h"

#include <algorithm>
#include <charconv>

namespace sahl {

namespace {

struct Step {
    std::string name;
    std::vector<std::size_t> indices;
};

[[noreturn]] void refuse(Place const& place, std::string_view key, std::string const& problem,
                         std::string const& remedy) {
    throw InputError(place.text().empty() ? std::string(key) : place.text(), problem, remedy);
}

Step parse_step(std::string_view part, std::string_view key, Place const& place) {
    auto const wrong = [&] {
        refuse(place, key, "'" + std::string(key) + "' is no key", "write keys as object.NAME.key[0]");
    };
    auto open = part.find('[');
    Step step{std::string(part.substr(0, open)), {}};
    if (step.name.empty())
        wrong();
    while (open != std::string_view::npos && open < part.size()) {
        auto const close = part.find(']', open);
        std::size_t index = 0;
        if (part[open] != '[' || close == std::string_view::npos)
            wrong();
        auto const [end, error] = std::from_chars(part.data() + open + 1, part.data() + close, index);
        if (error != std::errc() || end != part.data() + close)
            wrong();
        step.indices.push_back(index);
        open = close + 1;
    }
    return step;
}

std::vector<Step> parse_key(std::string_view key, Place const& place) {
    std::vector<Step> steps;
    for (std::size_t start = 0; start <= key.size();) {
        auto const end = std::min(key.find('.', start), key.size());
        steps.push_back(parse_step(key.substr(start, end - start), key, place));
        start = end + 1;
    }
    return steps;
}

Value& find_named(Array& tables, std::string const& name, std::string const& list, std::string_view key,
                  Place const& place) {
    std::vector<std::string> names;
    for (Value& table : tables) {
        Value const* own = table.find("name");
        auto const* text = own ? std::get_if<std::string>(&own->data) : nullptr;
        if (text && *text == name)
            return table;
        if (text)
            names.push_back(*text);
    }
    refuse(place, key, "there is no " + list + " \"" + name + "\"", did_you_mean(name, names));
}

/// The default of a list such as object.NAME.turn_deg, so that one of its elements can be set.
std::optional<Array> default_list(std::string const& table_name, std::string const& name,
                                  Place const& place) {
    for (KeyTable const* table : key_tables()) {
        if (table->title != "[[" + table_name + "]]" && table->title != "[" + table_name + "]")
            continue;
        for (Key const& key : table->keys)
            if (auto const* repeated = std::get_if<Repeated>(&key.fallback); repeated && key.name == name)
                return Array(static_cast<std::size_t>(repeated->count), Value{repeated->value, place});
    }
    return {};
}

std::vector<std::string> keys_of(Value const& table) {
    std::vector<std::string> keys;
    for (auto const& [key, value] : std::get<Table>(table.data))
        keys.push_back(key);
    return keys;
}

} // namespace

void set_key(Value& experiment, std::string_view key, Value value) {
    Place const place = value.place;
    auto const steps = parse_key(key, place);
    Value* current = &experiment;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        Step const& step = steps[i];
        bool const is_list = i == 0 && (step.name == "object" || step.name == "source" ||
                                        step.name == "detector" || step.name == "group");
        if (auto* tables = std::get_if<Array>(&current->data))
            current = &find_named(*tables, step.name, steps[i - 1].name, key, place);
        else if (auto* table = std::get_if<Table>(&current->data)) {
            if (!current->find(step.name)) {
                if (is_list)
                    refuse(place, key, "there is no " + step.name + " in this experiment",
                           "add [[" + step.name + "]] to the file");
                std::optional<Array> list;
                if (!step.indices.empty() && !(list = default_list(steps[0].name, step.name, place)))
                    refuse(place, key, "there is no list '" + step.name + "' to set an element of",
                           did_you_mean(step.name, keys_of(*current)));
                table->emplace_back(step.name, Value{Table{}, place});
                if (list)
                    table->back().second.data = std::move(*list);
            }
            current = current->find(step.name);
        } else
            refuse(place, key, "'" + step.name + "' cannot be set in something that is no table",
                   "shorten the key");
        for (std::size_t const index : step.indices) {
            auto* array = std::get_if<Array>(&current->data);
            if (!array || index >= array->size())
                refuse(place, key, "'" + step.name + "' has no element " + std::to_string(index),
                       !array || array->empty()
                           ? "it is no list of values"
                           : "give an index from 0 to " + std::to_string(array->size() - 1));
            current = &(*array)[index];
        }
    }
    *current = std::move(value);
}

namespace {

void place_everywhere(Value& value, Place const& place) {
    value.place = place;
    if (auto* array = std::get_if<Array>(&value.data))
        for (Value& item : *array)
            place_everywhere(item, place);
    if (auto* table = std::get_if<Table>(&value.data))
        for (auto& [key, item] : *table)
            place_everywhere(item, place);
}

/// A TOML value, or the text itself where it is none.
Value value_from_text(std::string const& text) {
    try {
        Value tree = parse_toml("value = " + text, "");
        auto& entries = std::get<Table>(tree.data);
        if (entries.size() == 1) // a line break in the text could have begun another key
            return std::move(entries.front().second);
    } catch (InputError const&) {
        return {text, {}}; // no TOML value: a word without its quotes
    }
    return {text, {}};
}

} // namespace

void set_key_from_text(Value& experiment, std::string_view assignment) {
    Place const place{"--set " + std::string(assignment), 0, 0, {}};
    auto const equals = assignment.find('=');
    if (equals == std::string_view::npos || equals == 0)
        throw InputError(place.text(), "this sets nothing",
                         "write --set KEY=VALUE, for instance --set trace.seed=2");
    auto const trimmed = [](std::string_view text) {
        auto const first = text.find_first_not_of(' ');
        return first == std::string_view::npos
                   ? std::string()
                   : std::string(text.substr(first, text.find_last_not_of(' ') - first + 1));
    };
    Value value = value_from_text(trimmed(assignment.substr(equals + 1)));
    place_everywhere(value, place);
    set_key(experiment, trimmed(assignment.substr(0, equals)), std::move(value));
}

} // namespace sahl

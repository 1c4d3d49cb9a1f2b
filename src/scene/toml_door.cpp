// In: the text of a TOML file. Out: a tree of values with line and column, tables in the order of the file.
// The only door to toml++.
#include "math/input_error.h"
#include "scene/value.h"

#include <toml++/toml.h>

#include <algorithm>

namespace sahl {

namespace {

Place place_of(toml::source_position const& position, std::string const& file) {
    return {file, static_cast<int>(position.line), static_cast<int>(position.column), {}};
}

Value to_value(toml::node const& node, Place const& place);

Table to_table(toml::table const& table, std::string const& file) {
    std::vector<std::pair<toml::key const*, toml::node const*>> entries;
    for (auto const& [key, node] : table)
        entries.emplace_back(&key, &node);
    std::stable_sort(entries.begin(), entries.end(), [](auto const& a, auto const& b) {
        return a.first->source().begin < b.first->source().begin;
    });
    Table values;
    for (auto const& [key, node] : entries)
        values.emplace_back(std::string(key->str()), to_value(*node, place_of(key->source().begin, file)));
    return values;
}

Array to_array(toml::array const& array, std::string const& file) {
    Array values;
    for (auto const& node : array)
        values.push_back(to_value(node, place_of(node.source().begin, file)));
    return values;
}

/// A value under a key stands where its key does; toml++ refuses more than 256 levels, so this recursion is
/// bounded.
Value to_value(toml::node const& node, Place const& place) {
    switch (node.type()) {
    case toml::node_type::table:
        return {to_table(*node.as_table(), place.file), place};
    case toml::node_type::array:
        return {to_array(*node.as_array(), place.file), place};
    case toml::node_type::string:
        return {**node.as_string(), place};
    case toml::node_type::integer:
        return {**node.as_integer(), place};
    case toml::node_type::floating_point:
        return {**node.as_floating_point(), place};
    case toml::node_type::boolean:
        return {**node.as_boolean(), place};
    default:
        throw InputError(place.text(), "this is a date or a time, which no key takes",
                         "put it in quotes if text was meant");
    }
}

} // namespace

Value parse_toml(std::string_view text, std::string const& file) {
    try {
        return {to_table(toml::parse(text, file), file), {file, 0, 0, {}}};
    } catch (toml::parse_error const& error) {
        std::string const problem(error.description());
        bool const in_text = problem.find("parsing string") != std::string::npos;
        throw InputError(place_of(error.source().begin, file).text(), problem,
                         in_text ? "is the quote that closes this text missing?"
                                 : "mend the TOML there, or in the line before");
    }
}

} // namespace sahl

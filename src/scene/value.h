// In: the text of a TOML or JSON file. Out: one tree of values, each with the place in the file it came from.
// The doors to toml++ and nlohmann-json stand in the two .cpp files named after them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace sahl {

/// Where a value stands. TOML gives line and column (from 1); JSON gives a pointer such as /object/0/name.
struct Place {
    std::string file;
    int line = 0;
    int column = 0;
    std::string pointer;

    /// "file:line:column", "file: /pointer" or "file".
    std::string text() const;
};

struct Value;
using Array = std::vector<Value>;
using Table = std::vector<std::pair<std::string, Value>>; // in the order of the file; keys are unique

struct Value {
    std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Table>
        data{}; // with braces, or clang 14 completes the pair in Table too early
    Place place;

    bool is_number() const { return data.index() == 2 || data.index() == 3; }
    /// The entry of a table, or nullptr (also where this is no table).
    Value const* find(std::string_view key) const;
    Value* find(std::string_view key);
};

/// A table without entries. Its body stands here, and default-constructs a Value, so that clang has all of
/// Value's members before it meets a std::pair of a Value, which asks whether it can be default-constructed.
inline Value empty_table() {
    Value table;
    table.data = Table{};
    return table;
}

/// Both throw InputError with line and column at a syntax error. JSON deeper than 256 levels is refused
/// before it is parsed.
Value parse_toml(std::string_view text, std::string const& file);
Value parse_json(std::string_view text, std::string const& file);

/// Two spaces a level; numbers are the shortest that read back to the same double; a number that is not
/// finite is null. Keys stand in the order of the table.
std::string to_json(Value const& value);

} // namespace sahl

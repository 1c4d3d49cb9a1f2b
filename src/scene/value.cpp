// In: a tree of values. Out: an entry of a table, a place as a message writes it.
#include "scene/value.h"

#include <algorithm>

namespace sahl {

std::string Place::text() const {
    if (line > 0)
        return file + ":" + std::to_string(line) + ":" + std::to_string(column);
    return pointer.empty() ? file : file + ": " + pointer;
}

Value const* Value::find(std::string_view key) const {
    auto const* table = std::get_if<Table>(&data);
    if (!table)
        return nullptr;
    auto const entry =
        std::find_if(table->begin(), table->end(), [&](auto const& e) { return e.first == key; });
    return entry == table->end() ? nullptr : &entry->second;
}

Value* Value::find(std::string_view key) {
    return const_cast<Value*>(static_cast<Value const*>(this)->find(key));
}

} // namespace sahl

// In: values of a glTF file's tree. Out: numbers in their range, names, extras.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <charconv>
#include <cmath>

namespace sahl::gltf {

Value const* find(Value const* table, std::string_view key) {
    return table ? table->find(key) : nullptr;
}

std::string text(double number) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr};
}

double at_least(Value const* value, double low, double otherwise, std::string const& remedy) {
    if (!value)
        return otherwise;
    auto const* const integer = std::get_if<std::int64_t>(&value->data);
    auto const* const real = std::get_if<double>(&value->data);
    if (!integer && !(real && std::isfinite(*real)))
        throw InputError(value->place.text(), "this must be a finite number", remedy);
    double const n = integer ? static_cast<double>(*integer) : *real;
    if (n < low)
        throw InputError(value->place.text(), text(n) + " is below " + text(low), remedy);
    return n;
}

double share(Value const* value, double otherwise) {
    double const n = at_least(value, 0.0, otherwise, "give a number from 0 to 1");
    if (n > 1.0)
        throw InputError(value->place.text(), text(n) + " is above 1", "give a number from 0 to 1");
    return n;
}

std::string short_name(std::string const& name) {
    constexpr std::size_t most = 200;
    if (name.size() <= most)
        return name;
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0u) == 0x80u) // not within a character
        --end;
    return name.substr(0, end);
}

std::string name_or(Value const& entry, std::string const& otherwise) {
    Value const* const name = entry.find("name");
    auto const* const known = name ? std::get_if<std::string>(&name->data) : nullptr;
    return known && !known->empty() ? short_name(*known) : otherwise;
}

std::string extras_of(Value const& entry) {
    Value const* const extras = entry.find("extras");
    return extras ? to_json(*extras) : std::string();
}

} // namespace sahl::gltf

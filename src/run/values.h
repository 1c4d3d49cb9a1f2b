// In: numbers, texts, vectors. Out: them as values of a tree that is written as JSON.
#pragma once

#include "math/vec.h"
#include "scene/value.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sahl {

inline Value of(double x) {
    return {std::isfinite(x) ? decltype(Value::data)(x) : decltype(Value::data)(std::monostate{}), {}};
}
inline Value of(std::uint64_t n) {
    return {static_cast<std::int64_t>(n), {}};
}
inline Value of(std::string text) {
    return {std::move(text), {}};
}
inline Value of(bool b) {
    return {b, {}};
}
inline Value of(Table table) {
    return {std::move(table), {}};
}
inline Value of(Array array) {
    return {std::move(array), {}};
}
inline Value of(std::vector<std::string> const& list) {
    Array array;
    for (std::string const& text : list)
        array.push_back(of(text));
    return of(std::move(array));
}
inline Value of(dvec3 const& v, double scale = 1.0) {
    return of(Array{of(v.x * scale), of(v.y * scale), of(v.z * scale)});
}
inline Value of(dvec2 const& v, double scale = 1.0) {
    return of(Array{of(v.x * scale), of(v.y * scale)});
}
inline Value nothing() {
    return {};
}

} // namespace sahl

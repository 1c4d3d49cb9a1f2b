// In: a check's report. Out: its values by their keys, and lines as they are shown. Shared by check_text.cpp,
// check_text_models.cpp and check_page.cpp alone.
#pragma once

#include "scene/value.h"

#include <cstdint>
#include <string>

namespace sahl {

// of objects, meshes, remarks: a page, not a listing; --json has all
constexpr std::size_t shown_at_once = 20;

// what is absent, or of another type, is empty, 0 or false
std::string string_at(Value const& table, char const* key);
double number_of(Value const& value);
double number_at(Value const& table, char const* key);
std::uint64_t count_at(Value const& table, char const* key);
bool is_true(Value const& table, char const* key);
Table const& table_at(Value const& table, char const* key);
Array const& list_at(Value const& table, char const* key);
/// Each as printf does by `format`.
std::string joined(Array const& numbers, char const* between, char const* format);
/// Breaks at blanks so that no line is longer than a terminal's; those after the first are indented.
std::string wrapped(std::string const& text, std::string const& first, std::string const& margin);

/// The health of each mesh.
std::string models_text(Table const& models);

} // namespace sahl

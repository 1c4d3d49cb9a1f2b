// In: a table of an experiment file and the declaration of its keys. Out: its values, checked, or an
// InputError.
#pragma once

#include "scene/keys.h"
#include "scene/value.h"

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sahl {

/// A table whose keys, types and ranges are right: what it was built from has been compared with its
/// declaration. Both arguments must outlive it.
class Fields {
  public:
    /// Throws InputError at an unknown key, an ill-typed value, a number out of range, a key that is missing.
    Fields(Value const& table, KeyTable const& declared);

    bool has(std::string_view key) const { return table_.find(key) != nullptr; }
    /// What is written under a key that is there.
    Value const& at(std::string_view key) const;

    /// What is written, or else the declared default; there must be one of the two.
    bool truth(std::string_view key) const;
    double number(std::string_view key) const;
    std::int64_t integer(std::string_view key) const;
    std::string text(std::string_view key) const;
    std::vector<double> numbers(std::string_view key) const; // empty where there is neither

    /// Where a key stands, or where the table does.
    Place const& place(std::string_view key) const { return has(key) ? at(key).place : table_.place; }
    Place const& place() const { return table_.place; }

    /// Which one of these keys is there. Throws InputError where none is, or more than one.
    std::string only_one_of(std::initializer_list<std::string_view> keys) const;

    /// The choice that the text under `key` names. Throws InputError with the nearest one.
    template <class Choice>
    Choice choice(std::string_view key,
                  std::initializer_list<std::pair<std::string_view, Choice>> choices) const {
        std::string const word = text(key);
        std::vector<std::string> names;
        for (auto const& [name, value] : choices) {
            if (name == word)
                return value;
            names.emplace_back(name);
        }
        refuse_choice(key, names);
    }

    /// "'key' in table": how a message names a value.
    std::string called(std::string_view key) const;

  private:
    Key const& declaration(std::string_view key) const;
    [[noreturn]] void refuse_choice(std::string_view key, std::vector<std::string> const& names) const;

    Value const& table_;
    KeyTable const& declared_;
};

/// Whether a value's type and, for a list, its size are those of the kind. Ranges are not looked at.
bool has_kind(Value const& value, Kind kind);

double number_in(Value const& value); // is_number()
std::vector<double> numbers_in(Array const& array);

/// [[a, b], …] with ascending a. Throws InputError at the first row that is not so.
std::vector<std::pair<double, double>> ascending_pairs(Value const& list);

/// "-3", "\"abc\"", "a list of 3": a value as a message quotes it.
std::string quoted_value(Value const& value);

/// "did you mean 'radius_mm'?" A known name that is the word and a unit ("at": "at_mm"), or that ends in it
/// ("BK7": "N-BK7"), goes before the nearest by letters; the case of letters does not count. Empty where
/// nothing is known.
std::string did_you_mean(std::string_view word, std::vector<std::string> const& known);

/// "a, b, c"
std::string listed(std::vector<std::string> const& names);

/// A name that can be part of a key: not empty, without dots, brackets, '=' and control characters.
void check_name(std::string const& name, Place const& place);

/// The tables of a list [[…]] that may be absent.
Array const& tables_in(Value const& tree, std::string_view key);

} // namespace sahl

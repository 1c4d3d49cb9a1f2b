// In: the bank of expected values, truth_public.json, where the shared data are. Out: its cases, and what a
// run's number is compared with.
#pragma once

#include "scene/value.h"

#include <string>
#include <string_view>
#include <vector>

namespace sahl::bench {

/// One case: decimals of 17 digits from 50-digit arithmetic, read as doubles.
struct BankCase {
    std::string id, kind;
    Value inputs, outputs;
    double tolerance = 0.0; // what the bank suggests, in the unit of the value

    double input(std::string_view key) const;
    Value const& input_value(std::string_view key) const;
    double output(std::string_view key) const;
};

/// All cases; none, with a warning, where the shared data are absent.
std::vector<BankCase> bank();
std::vector<BankCase> bank(std::string_view kind);

/// A decimal in a string, or a number.
double decimal(Value const& value);

/// Checks a measured value against an output of the case, to the case's tolerance or to one that is argued
/// for.
void agrees(BankCase const& expected, std::string_view key, double measured);
void agrees(BankCase const& expected, std::string_view key, double measured, double tolerance);

} // namespace sahl::bench

#include "support/bank.h"

#include "scene/read_file.h"
#include "support/catch.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace sahl::bench {

namespace {

Value const& entry(Value const& table, std::string_view key) {
    Value const* const found = table.find(key);
    INFO("the bank's case has no " << key);
    REQUIRE(found);
    return *found;
}

std::string text_of(Value const& value) {
    return std::get<std::string>(value.data);
}

} // namespace

double decimal(Value const& value) {
    if (auto const* const whole = std::get_if<std::int64_t>(&value.data))
        return static_cast<double>(*whole);
    if (auto const* const real = std::get_if<double>(&value.data))
        return *real;
    auto const* const digits = std::get_if<std::string>(&value.data);
    REQUIRE(digits);
    return std::strtod(digits->c_str(), nullptr);
}

double BankCase::input(std::string_view key) const {
    return decimal(entry(inputs, key));
}
Value const& BankCase::input_value(std::string_view key) const {
    return entry(inputs, key);
}
double BankCase::output(std::string_view key) const {
    return decimal(entry(outputs, key));
}

std::vector<BankCase> bank() {
    std::vector<BankCase> cases;
    std::filesystem::path const file = std::filesystem::path(SAHL_SHARED_DATA) / "truth_public.json";
    if (!std::filesystem::exists(file)) {
        WARN("skipped: no shared data");
        return cases;
    }
    Value const all = parse_json(file_text(file), file.string());
    for (Value const& one : std::get<Array>(entry(all, "cases").data))
        cases.push_back({text_of(entry(one, "id")), text_of(entry(one, "kind")), entry(one, "inputs"),
                         entry(one, "outputs"), decimal(entry(one, "suggested_abs_tol_double"))});
    return cases;
}

std::vector<BankCase> bank(std::string_view kind) {
    std::vector<BankCase> cases;
    std::vector<BankCase> const all = bank();
    for (BankCase const& one : all)
        if (one.kind == kind)
            cases.push_back(one);
    if (!all.empty())
        REQUIRE(!cases.empty());
    return cases;
}

void agrees(BankCase const& expected, std::string_view key, double measured) {
    agrees(expected, key, measured, expected.tolerance);
}

void agrees(BankCase const& expected, std::string_view key, double measured, double tolerance) {
    double const value = expected.output(key), deviation = std::abs(measured - value);
    INFO(expected.id << ": " << key);
    CAPTURE(value, measured, deviation, tolerance);
    CHECK(deviation <= tolerance);
}

} // namespace sahl::bench

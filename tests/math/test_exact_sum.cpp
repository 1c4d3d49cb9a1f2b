// What ExactSum promises: the same bits in any order and grouping, and the right value to an ulp.
#include "math/exact_sum.h"
#include "support/catch.h"
#include "support/dice.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

using namespace sahl;
using bench::Dice;

namespace {

constexpr SumUnit watt{-90};

ExactSum sum_of(std::vector<double> const& numbers, SumUnit unit = watt) {
    ExactSum sum;
    for (double x : numbers)
        sum.add(x, unit);
    return sum;
}

double value_of(std::vector<double> const& numbers, SumUnit unit = watt) {
    return sum_of(numbers, unit).value(unit);
}

/// Magnitudes from 1e-40 to 1 of either sign.
std::vector<double> mixed(std::size_t count, std::uint64_t seed) {
    Dice dice(seed);
    std::vector<double> numbers(count);
    for (double& x : numbers)
        x = dice.sign() * dice.log_between(1e-40, 1.0);
    return numbers;
}

template <class Random>
void shuffle(std::vector<double>& numbers, Random& dice) {
    for (std::size_t i = numbers.size(); i > 1; --i)
        std::swap(numbers[i - 1], numbers[dice.below(i)]);
}

} // namespace

TEST_CASE("a sum is the same whatever the order") {
    std::vector<double> numbers = mixed(10'000, 1);
    ExactSum const sum = sum_of(numbers);
    Dice dice(2);
    for (int k = 0; k < 10; ++k) {
        shuffle(numbers, dice);
        CHECK(sum_of(numbers) == sum);
    }
    std::sort(numbers.begin(), numbers.end());
    CHECK(sum_of(numbers) == sum);
}

TEST_CASE("a sum is the same whatever the grouping") {
    std::vector<double> const numbers = mixed(10'000, 3);
    ExactSum const sum = sum_of(numbers);
    Dice dice(4);
    for (int k = 0; k < 10; ++k) {
        ExactSum groups;
        for (auto first = numbers.begin(); first != numbers.end();) {
            auto const size = std::min<std::uint64_t>(1 + dice.below(3000),
                                                      static_cast<std::uint64_t>(numbers.end() - first));
            auto const last = first + static_cast<std::ptrdiff_t>(size);
            groups.add(sum_of({first, last}));
            first = last;
        }
        CHECK(groups == sum);
    }
}

TEST_CASE("subtracting what was added leaves nothing") {
    std::vector<double> numbers = mixed(1000, 5);
    ExactSum rest = sum_of(numbers);
    std::reverse(numbers.begin(), numbers.end());
    rest.subtract(sum_of(numbers));
    CHECK(rest == ExactSum{});
    CHECK(rest.value(watt) == 0.0);
}

TEST_CASE("a single number comes back as it was") {
    // every double whose last bit is not below the unit: 2⁻⁹⁰ carries all 53 bits of numbers from 2⁻³⁸ on
    Dice dice(6);
    for (int k = 0; k < 10'000; ++k) {
        double const x = dice.sign() * dice.log_between(0x1p-38, 0x1p36);
        CHECK(value_of({x}) == x);
    }
    for (double x :
         {0x1p-90, -0x1p-90, 0x1p-38, -0x1p-38, 0x1p36, -0x1p36, 0.0, 0.5, -0.5, 1.0, 3.0 * 0x1p-90})
        CHECK(value_of({x}) == x);
    CHECK(value_of({}) == 0.0);
}

TEST_CASE("what lies below the unit is cut off towards minus infinity") {
    double const unit = 0x1p-90, smallest = std::numeric_limits<double>::denorm_min();
    double const normal = std::numeric_limits<double>::min();
    for (double x : {0.5 * unit, 0.999 * unit, normal, smallest, 1e-310, 0.0, -0.0}) {
        CHECK(value_of({x}) == 0.0);
        CHECK(value_of({unit + x}) == unit);
    }
    for (double x : {0.5 * unit, 0.999 * unit, normal, smallest, 1e-310})
        CHECK(value_of({-x}) == -unit);
    CHECK(value_of({1.5 * unit}) == unit);
    CHECK(value_of({-1.5 * unit}) == -2.0 * unit);
}

TEST_CASE("denormal numbers count where the unit is small enough") {
    double const smallest = std::numeric_limits<double>::denorm_min(); // 2⁻¹⁰⁷⁴
    SumUnit const fine{-1074};
    CHECK(value_of({smallest, smallest, smallest}, fine) == 3.0 * smallest);
    CHECK(value_of({-smallest, 1e-310}, fine) == 1e-310 - smallest);
    double const normal = std::numeric_limits<double>::min();
    CHECK(value_of({normal, -smallest}, fine) == normal - smallest);
}

TEST_CASE("small negative totals keep their sign and their digits") {
    CHECK(value_of({1.0, -1.0 - 0x1p-52}) == -0x1p-52);
    CHECK(value_of({1.0, -1.0, -0x1p-90}) == -0x1p-90);
    CHECK(value_of({0x1p36, -0x1p36, -0x1p-80, -0x1p-80}) == -0x1p-79);
}

TEST_CASE("a million terms agree with a sum of 128-bit whole numbers") {
    // whole multiples of 2⁻⁸⁰: the oracle counts them without rounding, in another unit
    Dice dice(7);
    ExactSum sum;
    Int128 whole = 0;
    for (int k = 0; k < 1'000'000; ++k) {
        auto const count =
            static_cast<std::int64_t>(dice.below(std::uint64_t{1} << 53)) - (std::int64_t{1} << 51);
        int const shift = static_cast<int>(dice.below(28)); // up to 2⁻⁸⁰⁺⁵³⁺²⁷ = 1
        whole += Int128{count} << shift;
        sum.add(std::ldexp(static_cast<double>(count), shift - 80), watt);
    }
    long double const expected = std::ldexp(static_cast<long double>(whole), -80);
    double const ulp = std::numeric_limits<double>::epsilon() * static_cast<double>(std::abs(expected));
    CHECK(std::abs(static_cast<long double>(sum.value(watt)) - expected) <= ulp);
    CHECK(std::abs(expected) > 1e3L); // so that there is something to agree on
}

TEST_CASE("a million shares of a watt make a watt") {
    // each share is off by half an ulp at most, in one direction: 1e6 · 2⁻⁵³ · 1e-6
    ExactSum sum;
    for (int k = 0; k < 1'000'000; ++k)
        sum.add(1e-6, watt);
    CHECK(std::abs(sum.value(watt) - 1.0) <= 0x1p-53 + 0x1p-52);
}

TEST_CASE("the unit follows the expected total over all magnitudes") {
    for (double total : {1e-300, 1e-30, 1e-6, 1.0, 1000.0, 1e30, 1e300}) {
        SumUnit const unit = SumUnit::for_total(total);
        std::vector<double> shares(1000, total / 1000.0);
        CHECK(value_of(shares, unit) == Approx(total).epsilon(1e-13));
        CHECK(value_of({total, -total / 3.0}, unit) == Approx(total / 1.5).epsilon(1e-15));
    }
    CHECK(SumUnit::for_total(0.0).exponent == -90);
}

// The counter-based random numbers: the published vectors, and that numbers of different keys know nothing of
// each other.
#include "math/random.h"
#include "support/catch.h"

#include <cmath>
#include <set>
#include <vector>

using namespace sahl;

namespace {

using Block = std::array<std::uint64_t, 4>;
constexpr int sample = 1 << 18;

/// Correlation of two lists of numbers that are uniform in [0, 1), in standard deviations of what chance
/// gives.
double correlation_in_sigmas(std::vector<double> const& a, std::vector<double> const& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += (a[i] - 0.5) * (b[i] - 0.5);
    return sum * 12.0 / std::sqrt(static_cast<double>(a.size()));
}

template <class Key>
std::vector<double> numbers(Key key) {
    std::vector<double> list(sample);
    for (std::uint64_t i = 0; i < list.size(); ++i)
        list[i] = key(i);
    return list;
}

} // namespace

TEST_CASE("Philox gives the known answers of its authors") {
    constexpr std::uint64_t all = ~std::uint64_t{0};
    CHECK(philox4x64({0, 0, 0, 0}, {0, 0}) ==
          Block{0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b});
    CHECK(philox4x64({all, all, all, all}, {all, all}) ==
          Block{0x87b092c3013fe90b, 0x438c3c67be8d0224, 0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0});
    CHECK(philox4x64({0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89},
                     {0x452821e638d01377, 0xbe5466cf34e90c6c}) == // digits of π
          Block{0xa528f45403e61d95, 0x38c72dbd566e9788, 0xa5a1610e72fd18b5, 0x57bd43b5e52b7fe6});
}

TEST_CASE("a random number depends on its key and on nothing else") {
    double const first = uniform(1, 2, 3, 4);
    uniform(9, 9, 9, 9);
    CHECK(uniform(1, 2, 3, 4) == first);
    CHECK(uniform(0, 2, 3, 4) != first);
    CHECK(uniform(1, 0, 3, 4) != first);
    CHECK(uniform(1, 2, 0, 4) != first);
    CHECK(uniform(1, 2, 3, 0) != first);
}

TEST_CASE("random numbers are uniform along every part of the key") {
    std::vector<std::vector<double>> const lists{
        numbers([](std::uint64_t i) { return uniform(i, 0, 0, 0); }),
        numbers([](std::uint64_t i) { return uniform(1, i, 0, 0); }),
        numbers([](std::uint64_t i) { return uniform(1, 7, i, 0); }),
        numbers([](std::uint64_t i) { return uniform(1, 7, 0, static_cast<std::uint32_t>(i)); })};
    for (auto const& list : lists) {
        double mean = 0.0, square = 0.0;
        std::vector<int> bins(256);
        for (double const u : list) {
            REQUIRE(u >= 0.0);
            REQUIRE(u < 1.0);
            mean += u / sample;
            square += (u - 0.5) * (u - 0.5) / sample;
            ++bins[static_cast<std::size_t>(u * 256)];
        }
        CHECK(std::abs(mean - 0.5) < 4.5 * std::sqrt(1.0 / 12 / sample)); // 4.5 sigmas: 1 in 150 000
        CHECK(std::abs(square - 1.0 / 12) < 4.5 * std::sqrt(1.0 / 180 / sample));
        double chi_square = 0.0;
        for (int const n : bins)
            chi_square += (n - sample / 256.0) * (n - sample / 256.0) / (sample / 256.0);
        CHECK(std::abs(chi_square - 255) < 4.5 * std::sqrt(2.0 * 255));
    }
}

TEST_CASE("numbers of neighbouring keys do not correlate") {
    auto const base = numbers([](std::uint64_t i) { return uniform(1, i, 0, 0); });
    CHECK(std::abs(correlation_in_sigmas(base, base)) > 100); // the measure sees what is equal
    CHECK(std::abs(correlation_in_sigmas(
              base, numbers([](std::uint64_t i) { return uniform(2, i, 0, 0); }))) < 4.5);
    CHECK(std::abs(correlation_in_sigmas(
              base, numbers([](std::uint64_t i) { return uniform(1, i + 1, 0, 0); }))) < 4.5);
    CHECK(std::abs(correlation_in_sigmas(
              base, numbers([](std::uint64_t i) { return uniform(1, i, 1, 0); }))) < 4.5);
    CHECK(std::abs(correlation_in_sigmas(
              base, numbers([](std::uint64_t i) { return uniform(1, i, 0, 1); }))) < 4.5);
}

TEST_CASE("random numbers have all their 53 bits") {
    std::uint64_t seen = 0;
    for (std::uint64_t i = 0; i < 256; ++i) {
        double const scaled = uniform(1, i, 0, 0) * 0x1p53;
        REQUIRE(scaled == std::floor(scaled));
        seen |= static_cast<std::uint64_t>(scaled);
    }
    CHECK(seen == (std::uint64_t{1} << 53) - 1);
}

TEST_CASE("every place of a tree of 16 levels has its own hash") {
    std::set<std::uint64_t> seen{0};
    std::vector<std::uint64_t> level{0};
    std::size_t places = 1;
    for (int depth = 0; depth < 16; ++depth) {
        std::vector<std::uint64_t> next;
        for (std::uint64_t const place : level)
            for (std::uint32_t choice = 0; choice < 2; ++choice)
                next.push_back(child_place(place, choice));
        seen.insert(next.begin(), next.end());
        places += next.size();
        level = next;
    }
    CHECK(seen.size() == places);
}

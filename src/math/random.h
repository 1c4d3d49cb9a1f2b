// In: a key. Out: a random number in [0, 1) that depends on nothing else: no state, no order, no thread.
// Philox4x64-10 of J. K. Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC11 (2011),
// section 4.3.
#pragma once

#include <array>
#include <cstdint>

namespace sahl {

/// The block cipher itself: ten rounds on a counter of 256 bits under a key of 128; every counter gives
/// another block.
inline std::array<std::uint64_t, 4> philox4x64(std::array<std::uint64_t, 4> counter,
                                               std::array<std::uint64_t, 2> key) {
    __extension__ using Wide = unsigned __int128;
    for (int round = 0; round < 10; ++round) {
        Wide const a = Wide{0xD2E7470EE14C6C93} * counter[0];
        Wide const b = Wide{0xCA5A826395121157} * counter[2];
        counter = {static_cast<std::uint64_t>(b >> 64) ^ counter[1] ^ key[0], static_cast<std::uint64_t>(b),
                   static_cast<std::uint64_t>(a >> 64) ^ counter[3] ^ key[1], static_cast<std::uint64_t>(a)};
        key[0] += 0x9E3779B97F4A7C15; // the golden ratio and √3 − 1, times 2⁶⁴
        key[1] += 0xBB67AE8584CAA73B;
    }
    return counter;
}

/// Uniform in [0, 1), a multiple of 2⁻⁵³; different keys give independent numbers, equal keys the same one.
/// seed    of the experiment
/// ray     its number in the experiment
/// place   where in the ray's tree: child_place of child_place … of 0
/// draw    which of the numbers that are drawn there
inline double uniform(std::uint64_t seed, std::uint64_t ray, std::uint64_t place, std::uint32_t draw) {
    return static_cast<double>(philox4x64({ray, place, draw, 0}, {seed, 0})[0] >> 11) * 0x1p-53;
}

/// A bijection of 64-bit words that spreads every bit over all: the finaliser of SplitMix64 (G. L. Steele et
/// al., "Fast splittable pseudorandom number generators", OOPSLA 2014).
constexpr std::uint64_t mix64(std::uint64_t word) {
    word = (word ^ (word >> 30)) * 0xBF58476D1CE4E5B9;
    word = (word ^ (word >> 27)) * 0x94D049BB133111EB;
    return word ^ (word >> 31);
}

/// The place that is reached from `place` by taking the branch `choice`: a hash of all choices from the root,
/// which is 0.
constexpr std::uint64_t child_place(std::uint64_t place, std::uint32_t choice) {
    return mix64(place + 0x9E3779B97F4A7C15 * (std::uint64_t{choice} + 1));
}

} // namespace sahl

// In: keys in a row. Out: for each the number of its kind, equal keys alike, numbered in the order of their
// first.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace sahl {

/// `key(i)` gives an array of 64-bit integers; `first` receives where each kind stands first. Below 2³² keys.
template <class KeyOf>
std::vector<std::uint32_t> number_kinds(std::size_t count, KeyOf const& key,
                                        std::vector<std::uint32_t>& first) {
    constexpr std::uint32_t empty = 0xFFFFFFFFu;
    std::vector<std::uint32_t> slots(std::bit_ceil(2 * count + 1),
                                     empty); // open addressing, at most half full
    std::vector<std::uint32_t> kind(count);
    std::size_t const mask = slots.size() - 1;
    for (std::size_t i = 0; i < count; ++i) {
        auto const mine = key(i);
        std::uint64_t hash = 0;
        for (std::uint64_t const part :
             mine) { // the finaliser of MurmurHash3: bits of floats are far from random
            hash = (hash ^ part) * 0xff51afd7ed558ccdULL;
            hash = (hash ^ hash >> 33) * 0xc4ceb9fe1a85ec53ULL;
            hash ^= hash >> 33;
        }
        std::size_t slot = hash & mask;
        while (slots[slot] != empty && key(first[slots[slot]]) != mine)
            slot = (slot + 1) & mask;
        if (slots[slot] == empty) {
            slots[slot] = static_cast<std::uint32_t>(first.size());
            first.push_back(static_cast<std::uint32_t>(i));
        }
        kind[i] = slots[slot];
    }
    return kind;
}

} // namespace sahl

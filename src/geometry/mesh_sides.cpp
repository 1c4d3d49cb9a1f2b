#include "geometry/mesh_sides.h"

#include <algorithm>

namespace sahl {

namespace {

struct Entry {
    std::uint32_t other; // the edge's higher place; its lower one is the bucket's
    std::uint32_t side;
};

constexpr std::size_t sorted_by_insertion = 24; // entries; above, std::sort is faster

void sort_bucket(std::span<Entry> bucket) {
    auto const less = [](Entry const& a, Entry const& b) {
        return a.other != b.other ? a.other < b.other : a.side < b.side;
    };
    if (bucket.size() > sorted_by_insertion)
        return std::sort(bucket.begin(), bucket.end(), less);
    for (std::size_t i = 1; i < bucket.size(); ++i)
        for (std::size_t j = i; j > 0 && less(bucket[j], bucket[j - 1]); --j)
            std::swap(bucket[j], bucket[j - 1]);
}

} // namespace

Sides pair_sides(std::span<Corners const> triangles, std::size_t places) {
    std::vector<std::uint32_t> begin(places + 2, 0);
    auto const each_side = [&](auto const& take) {
        for (std::uint32_t t = 0; t < triangles.size(); ++t)
            for (std::uint32_t i = 0; i < 3; ++i) {
                std::uint32_t const a = triangles[t][i], b = triangles[t][i == 2 ? 0 : i + 1];
                take(std::min(a, b), std::max(a, b), 3 * t + i);
            }
    };
    each_side([&](std::uint32_t low, std::uint32_t, std::uint32_t) { ++begin[low + 2]; });
    for (std::size_t i = 2; i < begin.size(); ++i)
        begin[i] += begin[i - 1];
    std::vector<Entry> entries(3 * triangles.size());
    each_side([&](std::uint32_t low, std::uint32_t high, std::uint32_t side) {
        entries[begin[low + 1]++] = {high, side};
    });

    Sides sides;
    sides.across.assign(3 * triangles.size(), Sides::border);
    auto const starts_at = [&](std::uint32_t side) { return triangles[side / 3][side % 3]; };
    for (std::size_t place = 0; place < places; ++place) {
        std::span<Entry> const bucket(entries.data() + begin[place], entries.data() + begin[place + 1]);
        sort_bucket(bucket);
        for (std::size_t i = 0, end = 0; i < bucket.size(); i = end) {
            for (end = i + 1; end < bucket.size() && bucket[end].other == bucket[i].other;)
                ++end;
            std::uint32_t const one = bucket[i].side;
            if (end - i == 2 && starts_at(one) != starts_at(bucket[i + 1].side)) {
                sides.across[one] = bucket[i + 1].side;
                sides.across[bucket[i + 1].side] = one;
            } else if (end - i > 1) {
                sides.crowded_edges.push_back(one);
                for (std::size_t k = i; k < end; ++k)
                    sides.across[bucket[k].side] = Sides::crowded;
            }
        }
    }
    return sides;
}

} // namespace sahl

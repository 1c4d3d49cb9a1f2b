// In: how many points are wanted. Out: where they lie. Lattices are counted in whole numbers, so that no
// rounding decides whether a point is in the disk.
#include "math/sequences.h"

#include "math/random.h"

#include <algorithm>
#include <cmath>

namespace sahl {
namespace {

constexpr double pi = 3.14159265358979323846;

std::uint32_t reverse_bits(std::uint32_t x) {
    x = ((x >> 1) & 0x55555555U) | ((x & 0x55555555U) << 1);
    x = ((x >> 2) & 0x33333333U) | ((x & 0x33333333U) << 2);
    x = ((x >> 4) & 0x0F0F0F0FU) | ((x & 0x0F0F0F0FU) << 4);
    x = ((x >> 8) & 0x00FF00FFU) | ((x & 0x00FF00FFU) << 8);
    return (x >> 16) | (x << 16);
}

/// Owen's scrambling of a fraction whose bits come reversed, least significant digit of the fraction on top:
/// products with even numbers carry only upwards, so each bit is flipped by a hash of the digits before it
/// (Burley 2020, listing 2).
std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t seed) {
    x += seed;
    x ^= x * 0x6C50B47CU;
    x ^= x * 0xB82F1E52U;
    x ^= x * 0xC7AFE638U;
    x ^= x * 0x8D22F6E6U;
    return reverse_bits(x);
}

/// Largest s ≥ 0 with s² ≤ x.
std::int64_t integer_root(std::int64_t x) {
    auto s = static_cast<std::int64_t>(std::sqrt(static_cast<double>(x)));
    while (s * s > x)
        --s;
    while ((s + 1) * (s + 1) <= x)
        ++s;
    return s;
}

/// How many whole numbers k of the parity of `j` have |k| ≤ bound.
std::int64_t count_like(std::int64_t j, std::int64_t bound) {
    return j % 2 == 0 ? 2 * (bound / 2) + 1 : 2 * ((bound + 1) / 2);
}

/// The first k ≥ −bound of the parity of `j`.
std::int64_t first_like(std::int64_t j, std::int64_t bound) {
    return (bound - j) % 2 == 0 ? -bound : 1 - bound;
}

/// Cells of the n × n grid have their centres at (k, j)/n, k and j of the parity of n − 1.
std::int64_t square_count(std::int64_t n) {
    std::int64_t count = 0;
    for (std::int64_t j = 1 - n; j < n; j += 2)
        count += count_like(n - 1, integer_root(n * n - j * j));
    return count;
}

/// Points of the triangular lattice are (k/2, j √3/2), k of the parity of j; their squared lengths (k² +
/// 3j²)/4 are whole.
std::int64_t hexagonal_count(std::int64_t square_length) {
    std::int64_t const rows = integer_root(4 * square_length / 3);
    std::int64_t count = 0;
    for (std::int64_t j = -rows; j <= rows; ++j)
        count += count_like(j, integer_root(4 * square_length - 3 * j * j));
    return count;
}

/// How many columns give cells whose width is nearest to `stretch` times their height, with `wanted` cells in
/// all.
double ideal_columns(double wanted, dvec2 const& size, double stretch) {
    if (!(size.x > 0.0))
        return 1.0;
    return size.y > 0.0 ? std::clamp(std::sqrt(wanted * size.x / (size.y * stretch)), 1.0, wanted) : wanted;
}

std::uint64_t divide_up(std::uint64_t a, std::uint64_t b) {
    return (a + b - 1) / b;
}

} // namespace

dvec2 sobol_2d(std::uint32_t index, std::uint64_t seed) {
    // First dimension: the digits of the index reversed. Second: primitive polynomial x + 1, m_1 = 1, so that
    // each direction number is the one before xor its half.
    std::uint32_t second = 0;
    for (std::uint32_t direction = 0x80000000U, rest = index; rest != 0;
         rest >>= 1, direction ^= direction >> 1)
        if (rest & 1U)
            second ^= direction;
    std::uint64_t const key = mix64(seed + 0x9E3779B97F4A7C15);
    return {scramble_reversed(index, static_cast<std::uint32_t>(key)) * 0x1p-32,
            scramble_reversed(reverse_bits(second), static_cast<std::uint32_t>(key >> 32)) * 0x1p-32};
}

dvec2 disk_from_square(dvec2 const& square) {
    dvec2 const p = 2.0 * square - 1.0;
    if (p.x == 0.0 && p.y == 0.0)
        return p;
    bool const wide = std::abs(p.x) > std::abs(p.y);
    double const radius = wide ? p.x : p.y;
    double const angle = wide ? pi / 4 * (p.y / p.x) : pi / 2 - pi / 4 * (p.x / p.y);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

std::vector<dvec2> square_grid_in_disk(std::uint64_t at_least) {
    // The cells whose centres are in the disk of radius n/2 cover no more than the disk of radius n/2 + √2/2.
    double const estimate = std::sqrt(4 / pi * static_cast<double>(at_least)) - std::sqrt(2.0);
    auto n = std::max<std::int64_t>(1, static_cast<std::int64_t>(estimate));
    std::int64_t count = square_count(n);
    while (count < static_cast<std::int64_t>(at_least))
        count = square_count(++n);

    std::vector<dvec2> points;
    points.reserve(static_cast<std::size_t>(count));
    for (std::int64_t j = 1 - n; j < n; j += 2) {
        std::int64_t const bound = integer_root(n * n - j * j);
        for (std::int64_t k = first_like(n - 1, bound); k <= bound; k += 2)
            points.push_back(dvec2(static_cast<double>(k), static_cast<double>(j)) / static_cast<double>(n));
    }
    return points;
}

std::vector<dvec2> square_grid_in_rectangle(std::uint64_t at_least, dvec2 const& size) {
    std::uint64_t const wanted = std::max<std::uint64_t>(1, at_least);
    double const ideal = ideal_columns(static_cast<double>(wanted), size, 1.0);
    auto const shape =
        [&](std::uint64_t columns) { // how far from square the cells are: 0, or the log of their aspect
            double const width = size.x / static_cast<double>(columns);
            double const height = size.y / static_cast<double>(divide_up(wanted, columns));
            return width > 0.0 && height > 0.0 ? std::abs(std::log(width / height)) : 0.0;
        };
    auto const below = static_cast<std::uint64_t>(ideal);
    std::uint64_t const above = std::min(below + 1, wanted);
    std::uint64_t const columns = shape(above) < shape(below) ? above : below;
    std::uint64_t const rows = divide_up(wanted, columns);

    std::vector<dvec2> points;
    points.reserve(columns * rows);
    for (std::uint64_t j = 0; j < rows; ++j)
        for (std::uint64_t i = 0; i < columns; ++i)
            points.push_back(size * (dvec2((static_cast<double>(i) + 0.5) / static_cast<double>(columns),
                                           (static_cast<double>(j) + 0.5) / static_cast<double>(rows)) -
                                     0.5));
    return points;
}

std::vector<dvec2> hexagonal_in_disk(std::uint64_t at_least) {
    auto const wanted = std::max<std::int64_t>(1, static_cast<std::int64_t>(at_least));
    // The smallest squared length within which there are enough points; 0 has one, q > 0 has more than q of
    // them.
    std::int64_t shell = 0;
    for (std::int64_t short_of = -1, enough = wanted; enough - short_of > 1; shell = enough) {
        std::int64_t const middle = short_of + (enough - short_of) / 2;
        (hexagonal_count(middle) >= wanted ? enough : short_of) = middle;
    }
    std::int64_t const count = hexagonal_count(shell);
    std::int64_t next = shell + 1;
    while (hexagonal_count(next) == count)
        ++next;

    // Equal shares of the area, as long as the last shell is in the disk and the next is not; squared lengths
    // are whole numbers, so a quarter keeps both off the rim.
    double const equal_shares = 2 * pi / (std::sqrt(3.0) * static_cast<double>(count));
    double const step = std::sqrt(std::clamp(equal_shares, 1.0 / (static_cast<double>(next) - 0.25),
                                             1.0 / (static_cast<double>(shell) + 0.25)));
    std::vector<dvec2> points;
    points.reserve(static_cast<std::size_t>(count));
    std::int64_t const rows = integer_root(4 * shell / 3);
    for (std::int64_t j = -rows; j <= rows; ++j) {
        std::int64_t const bound = integer_root(4 * shell - 3 * j * j);
        for (std::int64_t k = first_like(j, bound); k <= bound; k += 2)
            points.push_back(step / 2 *
                             dvec2(static_cast<double>(k), std::sqrt(3.0) * static_cast<double>(j)));
    }
    return points;
}

std::vector<dvec2> hexagonal_in_rectangle(std::uint64_t at_least, dvec2 const& size) {
    std::uint64_t const wanted = std::max<std::uint64_t>(1, at_least);
    double const ideal = ideal_columns(static_cast<double>(wanted), size, 2 / std::sqrt(3.0));
    auto const pairs = static_cast<std::uint64_t>(std::lround(static_cast<double>(wanted) / ideal / 2));
    std::uint64_t const rows = 2 * std::max<std::uint64_t>(1, pairs);
    std::uint64_t const columns = divide_up(wanted, rows);

    std::vector<dvec2> points;
    points.reserve(columns * rows);
    for (std::uint64_t j = 0; j < rows; ++j)
        for (std::uint64_t i = 0; i < columns; ++i)
            points.push_back(size * (dvec2((static_cast<double>(i) + (j % 2 == 0 ? 0.25 : 0.75)) /
                                               static_cast<double>(columns),
                                           (static_cast<double>(j) + 0.5) / static_cast<double>(rows)) -
                                     0.5));
    return points;
}

std::vector<dvec2> ring(std::uint64_t count) {
    std::vector<dvec2> points(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        double const angle = 2 * pi * static_cast<double>(i) / static_cast<double>(count);
        points[i] = {std::cos(angle), std::sin(angle)};
    }
    return points;
}

std::vector<dvec2> edge_of_rectangle(std::uint64_t count, dvec2 const& size) {
    std::vector<dvec2> points;
    for (std::uint64_t i = 0; i < count; ++i) {
        double const around = 2.0 * (size.x + size.y) * static_cast<double>(i) / static_cast<double>(count);
        double at = around + 0.5 * size.y; // from the lower right corner
        dvec2 corner(0.5, -0.5), along(0.0, 1.0);
        double side = size.y;
        for (int turn = 0; turn < 4 && at >= side; ++turn) {
            at -= side;
            corner += along;
            along = {-along.y, along.x};
            side = along.x == 0.0 ? size.y : size.x;
        }
        points.push_back(corner + along * (side > 0.0 ? std::min(at / side, 1.0) : 0.0));
    }
    return points;
}

std::vector<dvec2> fan(std::uint64_t count) {
    std::vector<dvec2> points(count, dvec2(0.0));
    double const last = static_cast<double>(count) - 1;
    for (std::uint64_t i = 0; count > 1 && i < count; ++i)
        points[i].y = (2 * static_cast<double>(i) - last) / last;
    return points;
}

} // namespace sahl

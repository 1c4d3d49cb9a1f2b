// In: doubles in any order. Out: their sum, the same bits whatever the order and the grouping.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace sahl {

__extension__ using Int128 = __int128;

/// The unit that a sum counts in: 2^exponent. Chosen 2⁻⁹⁰ of the largest total that is expected, it leaves 37
/// bits above.
struct SumUnit {
    int exponent = -90;

    /// For sums of magnitude `total` (finite, ≥ 0).
    static SumUnit for_total(double total) { return {(total > 0.0 ? std::ilogb(total) : 0) - 90}; }
};

/// A fixed-point sum. What lies below the unit is cut off towards −∞, number by number, so the sum is exact
/// in its unit.
class ExactSum {
  public:
    /// x must be finite and below 2³⁶ totals.
    void add(double x, SumUnit unit) {
        auto const bits = std::bit_cast<std::uint64_t>(x);
        int const biased = static_cast<int>((bits >> 52) & 0x7FF);
        auto mantissa = static_cast<std::int64_t>(bits & 0xFFFFFFFFFFFFF);
        if (biased != 0)
            mantissa |= std::int64_t{1} << 52;
        if (bits >> 63)
            mantissa = -mantissa;
        int const shift = (biased != 0 ? biased : 1) - 1075 - unit.exponent;
        if (shift >= 0)
            value_ += Int128{mantissa} << shift;
        else
            value_ += shift > -64 ? mantissa >> -shift : mantissa < 0 ? -1 : 0;
    }
    void add(ExactSum const& other) { value_ += other.value_; }
    void subtract(ExactSum const& other) { value_ -= other.value_; }

    /// To within an ulp.
    double value(SumUnit unit) const {
        Int128 const size = value_ < 0 ? -value_ : value_;
        double const high = static_cast<double>(static_cast<std::uint64_t>(size >> 64));
        double const low = static_cast<double>(static_cast<std::uint64_t>(size));
        return std::ldexp(value_ < 0 ? -(high * 0x1p64 + low) : high * 0x1p64 + low, unit.exponent);
    }
    Int128 units() const { return value_; }
    bool operator==(ExactSum const&) const = default;

  private:
    Int128 value_ = 0;
};

} // namespace sahl

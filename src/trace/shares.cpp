#include "trace/shares.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sahl {

namespace {

constexpr int digits = 52; // of a double's mantissa, behind the leading one

/// How finely a power near `power` can be given: its last place, but nothing below the unit.
int order_of(double power, SumUnit unit) {
    return power > 0.0 ? std::max(std::ilogb(power) - digits, unit.exponent) : unit.exponent;
}

/// What the ledger counts of a power: its whole units.
double in_whole_units(double power, SumUnit unit) {
    double const one = std::ldexp(1.0, unit.exponent);
    return power < std::ldexp(one, digits + 1) ? std::floor(power / one) * one : power;
}

/// The whole number of units that a double is, if it is one.
Int128 units_in(double x, SumUnit unit) {
    int exponent = 0;
    auto const mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), digits + 1));
    int const shift = exponent - digits - 1 - unit.exponent;
    return shift >= 0 ? Int128{mantissa} << shift : Int128{mantissa} >> std::min(-shift, 63);
}

} // namespace

std::vector<EqualShare> equal_shares(double power, std::vector<double> const& colour_shares,
                                     std::uint64_t rays, SumUnit unit) {
    std::vector<EqualShare> shares;
    Int128 rest = units_in(power, unit);
    for (double const share : colour_shares) {
        double const ideal = power * share / static_cast<double>(rays);
        int const order = order_of(ideal, unit);
        double const step = std::ldexp(1.0, order);
        shares.push_back({std::floor(ideal / step) * step, step, 0});
        rest -= units_in(shares.back().base, unit) * static_cast<Int128>(rays);
    }
    std::vector<std::size_t> coarse_first(shares.size());
    std::iota(coarse_first.begin(), coarse_first.end(), std::size_t{0});
    std::stable_sort(coarse_first.begin(), coarse_first.end(),
                     [&](std::size_t a, std::size_t b) { return shares[a].step > shares[b].step; });
    for (std::size_t const colour : coarse_first) {
        EqualShare& share = shares[colour];
        Int128 const step = units_in(share.step, unit), count = static_cast<Int128>(rays);
        Int128 steps = rest / step - (rest % step < 0 ? 1 : 0); // rounded down, so that what is left is ≥ 0
        rest -= steps * step;
        Int128 const each = steps / count - (steps % count < 0 ? 1 : 0);
        share.base += static_cast<double>(static_cast<std::int64_t>(each)) * share.step;
        share.raised = static_cast<std::uint64_t>(steps - each * count);
    }
    return shares;
}

void WeightedShares::add(std::uint64_t ray, double share) {
    share = in_whole_units(share, unit_);
    sum_.add(share, unit_);
    if (share <= 0.0)
        return;
    int const order = order_of(share, unit_);
    auto const [found, is_new] = by_order_.try_emplace(order, Adjusted{ray, share});
    // the least of an order has the most room above; of those that are finer than the unit the greatest bears
    // a unit best
    bool const better = order > unit_.exponent ? share < found->second.power : share > found->second.power;
    if (!is_new && better)
        found->second = {ray, share};
}

void WeightedShares::close(double power) {
    ExactSum total;
    total.add(power, unit_);
    total.subtract(sum_);
    Int128 rest = total.units();
    for (auto entry = by_order_.rbegin(); entry != by_order_.rend(); ++entry) {
        auto const& [ray, share] = entry->second;
        Int128 const step = units_in(std::ldexp(1.0, entry->first), unit_);
        double const better =
            share + std::ldexp(static_cast<double>(static_cast<std::int64_t>(rest / step)), entry->first);
        if (better == share || better <= 0.0)
            continue;
        adjusted_[ray] = better;
        rest -= units_in(better, unit_) - units_in(share, unit_);
    }
    by_order_.clear();
}

double WeightedShares::of(std::uint64_t ray, double share) const {
    auto const found = adjusted_.find(ray);
    return found != adjusted_.end() ? found->second : in_whole_units(share, unit_);
}

} // namespace sahl

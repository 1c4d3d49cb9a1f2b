// In: a source's power and the weights of its colours and rays. Out: the power of each ray, in doubles whose
// exact sum is the source's power.
#pragma once

#include "math/exact_sum.h"

#include <cstdint>
#include <map>
#include <vector>

namespace sahl {

/// Of the rays of one colour that all weigh the same: they differ by one rounding at most.
struct EqualShare {
    double base = 0.0, step = 0.0; // W
    std::uint64_t raised = 0;      // so many rays, the first ones, have base + step

    double of(std::uint64_t ray) const { return ray < raised ? base + step : base; }
};

/// One for each colour. power, the shares and `rays` are above 0; the shares add up to 1 within rounding. The
/// sum over all rays is exact in `unit`.
std::vector<EqualShare> equal_shares(double power, std::vector<double> const& colour_shares,
                                     std::uint64_t rays, SumUnit unit);

/// Of rays with weights of their own: each has its share, rounded, but a few (one of each binary order) that
/// make up for the roundings of all.
class WeightedShares {
  public:
    explicit WeightedShares(SumUnit unit) : unit_(unit) {}

    /// First once for every ray: its number and its share in W, rounding not looked at.
    void add(std::uint64_t ray, double share);
    /// Then the power that they are to have together.
    void close(double power);
    double of(std::uint64_t ray, double share) const;

  private:
    SumUnit unit_;
    ExactSum sum_;
    struct Adjusted {
        std::uint64_t ray;
        double power;
    };
    std::map<int, Adjusted> by_order_;
    std::map<std::uint64_t, double> adjusted_; // by ray
};

} // namespace sahl

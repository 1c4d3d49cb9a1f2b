// In: a function of one number, and where to look. Out: its least value or its zero, with few evaluations:
// R. P. Brent, Algorithms for Minimization without Derivatives, Prentice-Hall 1973, chapters 4 (zero) and
// 5 (localmin).
#pragma once

#include <functional>
#include <optional>

namespace sahl {

struct Solution {
    double x = 0.0, y = 0.0; // the best x evaluated, and the function there
};

/// A place in [a, b] where f is least, as parabolas through three points and golden sections find it: one of
/// several, if f has several. Ends when x is known to `tolerance` (> 0, absolute) and half an ulp of 3 x
/// more, or after `most` evaluations: empty.
std::optional<Solution> brent_minimum(std::function<double(double)> const& f, double a, double b,
                                      double tolerance, unsigned most);

/// A place in [a, b] where f changes sign, to `tolerance` (≥ 0, absolute) and four ulps of x; fa = f(a) and
/// fb = f(b) do not both lie on one side of 0. Empty after `most` evaluations.
std::optional<Solution> brent_zero(std::function<double(double)> const& f, double a, double fa, double b,
                                   double fb, double tolerance, unsigned most);

} // namespace sahl

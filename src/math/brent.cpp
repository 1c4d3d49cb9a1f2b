#include "math/brent.h"

#include <cmath>
#include <limits>
#include <utility>

namespace sahl {

namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon();
double const golden = (3.0 - std::sqrt(5.0)) / 2.0; // share of an interval, 0.38

} // namespace

std::optional<Solution> brent_minimum(std::function<double(double)> const& f, double a, double b,
                                      double tolerance, unsigned most) {
    if (a > b)
        std::swap(a, b);
    double x = a + golden * (b - a), w = x, v = x; // best, second best, the second best before
    double fx = f(x), fw = fx, fv = fx;
    double step = 0.0, before = 0.0; // this one, the one before the last
    for (unsigned made = 1;; ++made) {
        double const middle = 0.5 * (a + b), tol = ulp * std::abs(x) + tolerance;
        if (std::abs(x - middle) <= 2.0 * tol - 0.5 * (b - a))
            return Solution{x, fx};
        if (made >= most)
            return {};
        double p = 0.0, q = 0.0, r = 0.0;
        if (std::abs(before) > tol) { // the parabola's lowest point is at x + p / q
            r = (x - w) * (fx - fv);
            q = (x - v) * (fx - fw);
            p = (x - v) * q - (x - w) * r;
            q = 2.0 * (q - r);
            (q > 0.0 ? p : q) *= -1.0;
            r = std::exchange(before, step);
        }
        if (std::abs(p) < std::abs(0.5 * q * r) && p > q * (a - x) && p < q * (b - x)) {
            step = p / q;
            if (x + step - a < 2.0 * tol || b - x - step < 2.0 * tol)
                step = x < middle ? tol : -tol; // not too close to the ends
        } else {
            before = x < middle ? b - x : a - x;
            step = golden * before;
        }
        double const u = x + (std::abs(step) >= tol ? step : std::copysign(tol, step)), fu = f(u);
        if (fu <= fx) {
            (u < x ? b : a) = x;
            v = std::exchange(w, std::exchange(x, u));
            fv = std::exchange(fw, std::exchange(fx, fu));
        } else {
            (u < x ? a : b) = u;
            if (fu <= fw || w == x) {
                v = std::exchange(w, u);
                fv = std::exchange(fw, fu);
            } else if (fu <= fv || v == x || v == w) {
                v = u;
                fv = fu;
            }
        }
    }
}

std::optional<Solution> brent_zero(std::function<double(double)> const& f, double a, double fa, double b,
                                   double fb, double tolerance, unsigned most) {
    double c = a, fc = fa; // the zero lies between b, the best, and c
    double step = b - a, before = step;
    for (unsigned made = 0;; ++made) {
        if ((fb > 0.0) == (fc > 0.0)) {
            c = a;
            fc = fa;
            step = before = b - a;
        }
        if (std::abs(fc) < std::abs(fb)) {
            a = b;
            b = c;
            c = a;
            fa = fb;
            fb = fc;
            fc = fa;
        }
        double const tol = 2.0 * ulp * std::abs(b) + tolerance, half = 0.5 * (c - b);
        if (std::abs(half) <= tol || fb == 0.0)
            return Solution{b, fb};
        if (made >= most)
            return {};
        double p = 0.0, q = 0.0;
        if (std::abs(before) >= tol && std::abs(fa) > std::abs(fb)) {
            double const s = fb / fa;
            if (a == c) { // a line through two points
                p = 2.0 * half * s;
                q = 1.0 - s;
            } else { // a parabola, x over y, through three
                double const t = fa / fc, r = fb / fc;
                p = s * (2.0 * half * t * (t - r) - (b - a) * (r - 1.0));
                q = (t - 1.0) * (r - 1.0) * (s - 1.0);
            }
            (p > 0.0 ? q : p) *= -1.0;
        }
        bool const trusted =
            q != 0.0 && 2.0 * p < 3.0 * half * q - std::abs(tol * q) && p < std::abs(0.5 * before * q);
        before = trusted ? step : half;
        step = trusted ? p / q : half;
        a = b;
        fa = fb;
        b += std::abs(step) > tol ? step : std::copysign(tol, half);
        fb = f(b);
    }
}

} // namespace sahl

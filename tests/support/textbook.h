// In: angles and indices. Out: textbook formulas in their plainest form, written apart from src/ on purpose,
// and two helpers of any measurement: angles between directions, nodes of a quadrature.
#pragma once

#include "math/vec.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace sahl::bench {

inline double radians(double degrees) {
    return degrees * (std::numbers::pi / 180.0);
}
inline double degrees(double radians_) {
    return radians_ * (180.0 / std::numbers::pi);
}

/// In degrees, [0, 180]; precise at both ends. The directions need not be unit vectors.
inline double angle_deg(dvec3 const& a, dvec3 const& b) {
    return degrees(std::atan2(length(cross(a, b)), dot(a, b)));
}

/// Shares of s and p light that a boundary reflects, below the critical angle (Fresnel).
inline std::pair<double, double> reflectances(double n1, double n2, double incidence) {
    double const c1 = std::cos(incidence), s2 = n1 * std::sin(incidence) / n2, c2 = std::sqrt(1.0 - s2 * s2);
    double const s = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2), p = (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
    return {s * s, p * p};
}

/// What unpolarised light loses at one boundary.
inline double mean_reflectance(double n1, double n2, double incidence) {
    auto const [s, p] = reflectances(n1, n2, incidence);
    return 0.5 * (s + p);
}

struct Node {
    double x, weight;
};

/// Gauss–Legendre on [0, 1]; exact for polynomials of degree 2·count − 1. The roots by Newton's method from
/// Chebyshev's (Abramowitz and Stegun 25.4.29).
inline std::vector<Node> gauss_legendre(int count) {
    std::vector<Node> nodes;
    for (int i = 0; i < count; ++i) {
        double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 1.0;
        for (int step = 0; step < 8; ++step) { // quadratic convergence: five would do
            double before = 1.0, at = x;
            for (int k = 2; k <= count; ++k)
                before = std::exchange(at, ((2 * k - 1) * x * at - (k - 1) * before) / k);
            slope = count * (x * at - before) / (x * x - 1.0);
            x -= at / slope;
        }
        nodes.push_back({0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope)});
    }
    return nodes;
}

} // namespace sahl::bench

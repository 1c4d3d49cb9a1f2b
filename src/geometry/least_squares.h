// In: equations that are linear in a few unknowns. Out: what satisfies them best; and the least direction of
// a symmetric matrix.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace sahl {

template <std::size_t n>
using Unknowns = std::array<double, n>;

/// Normal equations of a linear least squares problem of few unknowns, well scaled.
template <std::size_t n>
struct Equations {
    std::array<std::array<double, n + 1>, n> rows{};
    void add(Unknowns<n> const& row, double right) {
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j)
                rows[i][j] += row[i] * row[j];
            rows[i][n] += row[i] * right;
        }
    }
    std::optional<Unknowns<n>> solved() {
        for (std::size_t k = 0; k < n; ++k) {
            std::size_t pivot = k;
            for (std::size_t i = k + 1; i < n; ++i)
                if (std::abs(rows[i][k]) > std::abs(rows[pivot][k]))
                    pivot = i;
            std::swap(rows[k], rows[pivot]);
            if (!(std::abs(rows[k][k]) > 1e-300))
                return std::nullopt;
            for (std::size_t i = 0; i < n; ++i)
                if (i != k) {
                    double const by = rows[i][k] / rows[k][k];
                    for (std::size_t j = k; j <= n; ++j)
                        rows[i][j] -= by * rows[k][j];
                }
        }
        Unknowns<n> x{};
        for (std::size_t k = 0; k < n; ++k)
            x[k] = rows[k][n] / rows[k][k];
        return x;
    }
};

/// The unit eigenvector of the least eigenvalue of a symmetric matrix, by Jacobi's rotations.
template <std::size_t n>
std::array<double, n> least_eigenvector(std::array<std::array<double, n>, n> a) {
    std::array<std::array<double, n>, n> v{}; // columns are the vectors
    for (std::size_t i = 0; i < n; ++i)
        v[i][i] = 1.0;
    for (int sweep = 0; sweep < 30; ++sweep)
        for (std::size_t p = 0; p < n; ++p)
            for (std::size_t q = p + 1; q < n; ++q) {
                if (std::abs(a[p][q]) <= 1e-18 * (std::abs(a[p][p]) + std::abs(a[q][q])))
                    continue;
                double const theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
                double const t =
                    std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
                double const c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
                auto const turn = [&](double& x, double& y) {
                    double const was = x;
                    x = c * was - s * y;
                    y = s * was + c * y;
                };
                for (std::size_t k = 0; k < n; ++k)
                    turn(a[k][p], a[k][q]);
                for (std::size_t k = 0; k < n; ++k)
                    turn(a[p][k], a[q][k]);
                for (std::size_t k = 0; k < n; ++k)
                    turn(v[k][p], v[k][q]);
            }
    std::size_t best = 0;
    for (std::size_t k = 1; k < n; ++k)
        if (a[k][k] < a[best][best])
            best = k;
    std::array<double, n> least{};
    for (std::size_t k = 0; k < n; ++k)
        least[k] = v[k][best];
    return least;
}

} // namespace sahl

// In: equations that are linear in some tens of unknowns, each with its weight. Out: what satisfies them
// best, also of the first unknowns alone.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sahl {

/// Σ a b in four chains, for speed.
inline double sum_of_products(double const* a, double const* b, std::size_t size) {
    std::array<double, 4> sum{};
    std::size_t i = 0;
    for (; i + 4 <= size; i += 4)
        for (std::size_t lane = 0; lane < 4; ++lane)
            sum[lane] += a[i + lane] * b[i + lane];
    for (; i < size; ++i)
        sum[0] += a[i] * b[i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// Least squares by Householder's reflections, column by column: what is found for the first columns alone is
/// there on the way.
template <std::size_t MostUnknowns>
class Householder {
  public:
    using Row = std::array<double, MostUnknowns>;

    Householder(std::size_t most_rows, std::size_t unknowns)
        : stride_(most_rows), unknowns_(unknowns), columns_((unknowns + 1) * most_rows) {}

    void add(Row const& row, double right, double weight) {
        for (std::size_t k = 0; k < unknowns_; ++k)
            column(k)[rows_] = weight * row[k];
        column(unknowns_)[rows_++] = weight * right;
    }

    /// How many of the first columns are independent.
    std::size_t reflect() {
        constexpr double independent = 1e-4; // of columns of about the same length: far above rounding
        for (std::size_t k = 0; k < unknowns_; ++k) {
            if (k >= rows_)
                return k;
            double* const head = column(k) + k;
            std::size_t const size = rows_ - k;
            double const rest = sum_of_products(head, head, size),
                         whole = rest + sum_of_products(column(k), column(k), k);
            if (!(rest > independent * independent * whole))
                return k;
            double const norm = std::copysign(std::sqrt(rest), -*head);
            *head -= norm; // Householder's vector; below its head the column itself
            double const scale = -1.0 / (norm * *head);
            for (std::size_t j = k + 1; j <= unknowns_; ++j) {
                double* const other = column(j) + k;
                double const by = scale * sum_of_products(head, other, size);
                for (std::size_t i = 0; i < size; ++i)
                    other[i] -= by * head[i];
            }
            *head = norm;
        }
        return unknowns_;
    }

    /// Of the first `unknowns` columns alone, which must be independent.
    Row solution(std::size_t unknowns) {
        Row x{};
        for (std::size_t k = unknowns; k-- > 0;) {
            double sum = column(unknowns_)[k];
            for (std::size_t j = k + 1; j < unknowns; ++j)
                sum -= column(j)[k] * x[j];
            x[k] = sum / column(k)[k];
        }
        return x;
    }

  private:
    double* column(std::size_t k) { return columns_.data() + k * stride_; }
    std::size_t stride_, unknowns_, rows_ = 0;
    std::vector<double> columns_;
};

} // namespace sahl

// In: numbered formulas and coefficients. Out: the dispersions, one row a formula.
#include "materials/formulas.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sahl {
namespace {

using Coefficients = std::span<double const>;
using Powers = std::vector<std::pair<double, double>>;

/// Pairs (coefficient, what stands with it) from the second number on.
Powers pairs_after_first(Coefficients c) {
    Powers pairs;
    for (std::size_t i = 1; i + 1 < c.size(); i += 2)
        pairs.emplace_back(c[i], c[i + 1]);
    return pairs;
}

/// Coefficients in the order of these exponents.
Powers powers(Coefficients c, std::initializer_list<double> exponents) {
    Powers pairs;
    std::size_t i = 0;
    for (double const exponent : exponents) {
        if (i < c.size() && c[i] != 0.0)
            pairs.emplace_back(c[i], exponent);
        ++i;
    }
    return pairs;
}

/// Terms b λ²/(λ² − c) from pairs (b, c); a pair with b = 0 is none.
Sellmeier sellmeier(double a, Coefficients pairs, bool squared = false) {
    Sellmeier formula{{}, {}, a};
    for (std::size_t i = 0; i + 1 < pairs.size(); i += 2)
        if (pairs[i] != 0.0) {
            formula.b.push_back(pairs[i]);
            formula.c_um2.push_back(squared ? pairs[i + 1] * pairs[i + 1] : pairs[i + 1]);
        }
    return formula;
}

/// c1 + c2 λ^c3/(λ² − c4^c5) + c6 λ^c7/(λ² − c8^c9) + Σ c10 λ^c11: what is not written is 0.
PolesAndPowers formula_4(Coefficients c) {
    PolesAndPowers formula{c[0], {}, {}};
    std::array<double, 9> head{};
    std::copy_n(c.begin(), std::min(c.size(), head.size()), head.begin());
    for (std::size_t i : {std::size_t(1), std::size_t(5)})
        if (head[i] != 0.0)
            formula.poles.push_back({head[i], head[i + 1], std::pow(head[i + 2], head[i + 3])});
    if (c.size() > 9)
        for (std::size_t i = 9; i + 1 < c.size(); i += 2)
            formula.powers.emplace_back(c[i], c[i + 1]);
    return formula;
}

/// c1 + c2 L + c3 L² + c4 λ² + c5 λ⁴ + c6 λ⁶: what is not written is 0.
IndexSeries herzberger(Coefficients c) {
    std::array<double, 6> a{};
    std::copy_n(c.begin(), std::min(c.size(), a.size()), a.begin());
    return {a[0], a[1], a[2], powers(Coefficients(a).subspan(3), {2, 4, 6})};
}

} // namespace

std::optional<Dispersion> page_formula(int number, std::span<double const> c) {
    bool const in_pairs = c.size() % 2 == 1;
    switch (number) {
    case 1:
    case 2:
        return in_pairs ? std::optional<Dispersion>(sellmeier(c[0], c.subspan(1), number == 1))
                        : std::nullopt;
    case 3:
        return in_pairs ? std::optional<Dispersion>(PowerSeries{c[0], pairs_after_first(c)}) : std::nullopt;
    case 4:
        return in_pairs && c.size() <= 17 ? std::optional<Dispersion>(formula_4(c)) : std::nullopt;
    case 5:
        return in_pairs ? std::optional<Dispersion>(IndexSeries{c[0], 0, 0, pairs_after_first(c)})
                        : std::nullopt;
    case 6:
        return in_pairs ? std::optional<Dispersion>(GasIndex{c[0], pairs_after_first(c)}) : std::nullopt;
    case 7:
        return !c.empty() && c.size() <= 6 ? std::optional<Dispersion>(herzberger(c)) : std::nullopt;
    case 8:
        return c.size() == 4 ? std::optional<Dispersion>(LorentzLorenz{c[0], c[1], c[2], c[3]})
                             : std::nullopt;
    case 9:
        return c.size() == 6 ? std::optional<Dispersion>(ResonantIndex{c[0], c[1], c[2], c[3], c[4], c[5]})
                             : std::nullopt;
    default:
        return std::nullopt;
    }
}

std::optional<Dispersion> agf_formula(int number, std::span<double const> coefficients) {
    if (coefficients.size() > 10)
        return std::nullopt;
    std::array<double, 10> c{};
    std::copy(coefficients.begin(), coefficients.end(), c.begin());
    Coefficients const all(c);
    switch (number) {
    case 1: // n² = a0 + a1 λ² + a2 λ⁻² + a3 λ⁻⁴ + a4 λ⁻⁶ + a5 λ⁻⁸
        return PowerSeries{c[0], powers(all.subspan(1, 5), {2, -2, -4, -6, -8})};
    case 2: // n² − 1 = Σ K λ²/(λ² − L), three terms
        return sellmeier(0.0, all.first(6));
    case 3:
        return herzberger(all.first(6));
    case 4: // n² − 1 = A + B1 λ²/(λ² − λ1²) + B2/(λ² − λ2²)
        return PolesAndPowers{1.0 + c[0], {{c[1], 2, c[2] * c[2]}, {c[3], 0, c[4] * c[4]}}, {}};
    case 5: // n = n0 + A/λ + B/λ^3.5
        return IndexSeries{c[0], 0, 0, powers(all.subspan(1, 2), {-1, -3.5})};
    case 6: // four terms
        return sellmeier(0.0, all.first(8));
    case 7: // n² = A + B/(λ² − C) − D λ²
        return PolesAndPowers{c[0], {{c[1], 0, c[2]}}, {{-c[3], 2}}};
    case 8: // n² = A + B λ²/(λ² − C) − D λ²
        return PolesAndPowers{c[0], {{c[1], 2, c[2]}}, {{-c[3], 2}}};
    case 9: // n² = A + B λ²/(λ² − C) + D λ²/(λ² − E)
        return sellmeier(c[0] - 1.0, all.subspan(1, 4));
    case 10: // as 1, and a6 λ⁻¹⁰ + a7 λ⁻¹²
        return PowerSeries{c[0], powers(all.subspan(1, 7), {2, -2, -4, -6, -8, -10, -12})};
    case 11: // five terms
        return sellmeier(0.0, all);
    case 12: // as 1, and a6 λ⁴ + a7 λ⁶
        return PowerSeries{c[0], powers(all.subspan(1, 7), {2, -2, -4, -6, -8, 4, 6})};
    case 13: // n² = a0 + a1 λ² + a2 λ⁴ + a3 λ⁻² + … + a8 λ⁻¹²
        return PowerSeries{c[0], powers(all.subspan(1, 8), {2, 4, -2, -4, -6, -8, -10, -12})};
    default:
        return std::nullopt;
    }
}

Dispersion agf_sellmeier_2_with_squares(std::span<double const> coefficients) {
    std::array<double, 10> c{};
    std::copy(coefficients.begin(), coefficients.end(), c.begin());
    return sellmeier(c[0], std::array{c[1], c[2] * c[2], c[3], c[4] * c[4]});
}

std::string_view agf_formula_name(int number) {
    constexpr std::array<std::string_view, 13> names{
        "Schott",      "Sellmeier 1", "Herzberger",           "Sellmeier 2",
        "Conrady",     "Sellmeier 3", "Handbook of Optics 1", "Handbook of Optics 2",
        "Sellmeier 4", "Extended",    "Sellmeier 5",          "Extended 2",
        "Extended 3"};
    return number >= 1 && number <= 13 ? names[static_cast<std::size_t>(number - 1)] : std::string_view();
}

} // namespace sahl

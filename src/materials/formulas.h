// In: a formula's number and its coefficients, as the refractiveindex.info database or a Zemax AGF file write
// them. Out: the dispersion.
#pragma once

#include "materials/dispersion.h"

#include <optional>
#include <span>
#include <string_view>

namespace sahl {

/// Formula 1 to 9 of the refractiveindex.info database (M. N. Polyanskiy, Scientific Data 11 (2024) 94), λ in
/// µm:
///   1: n² − 1 = c1 + Σ c2 λ²/(λ² − c3²)          2: n² − 1 = c1 + Σ c2 λ²/(λ² − c3)
///   3: n² = c1 + Σ c2 λ^c3                        5: n = c1 + Σ c2 λ^c3
///   4: n² = c1 + c2 λ^c3/(λ² − c4^c5) + c6 λ^c7/(λ² − c8^c9) + Σ c10 λ^c11
///   6: n − 1 = c1 + Σ c2/(c3 − λ⁻²)               7: Herzberger, n = c1 + c2 L + c3 L² + c4 λ² + c5 λ⁴ + c6
///   λ⁶ 8: (n² − 1)/(n² + 2) = c1 + c2 λ²/(λ² − c3) + c4 λ² 9: n² = c1 + c2/(λ² − c3) + c4 (λ − c5)/((λ −
///   c5)² + c6)
/// Formula 6 is absolute. Empty where there is no such formula, or where it does not have so many
/// coefficients.
std::optional<Dispersion> page_formula(int number, std::span<double const> coefficients);

/// Formula 1 to 13 of AGF files, λ in µm, as open programs read them (of formula 4 COMSOL); coefficients that
/// are missing are 0:
///   1 Schott, 2 Sellmeier 1, 3 Herzberger, 4 Sellmeier 2, 5 Conrady, 6 Sellmeier 3, 7 and 8 Handbook of
///   Optics 1 and 2, 9 Sellmeier 4, 10 Extended, 11 Sellmeier 5, 12 Extended 2, 13 Extended 3.
/// Empty for any other number, and for more than ten coefficients.
std::optional<Dispersion> agf_formula(int number, std::span<double const> coefficients);

/// Formula 4 as many programs read it: n² − 1 = A + B1 λ²/(λ² − λ1²) + B2 λ²/(λ² − λ2²). At most ten
/// coefficients.
Dispersion agf_sellmeier_2_with_squares(std::span<double const> coefficients);

/// What AGF files call formula 1 to 13: "Schott". Empty for any other number.
std::string_view agf_formula_name(int number);

} // namespace sahl

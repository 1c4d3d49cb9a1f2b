// In: a wavelength. Out: the refractive index by the formulas that glass makers and glTF use.
// Wavelengths are those in standard air, indices relative to air; formulas take λ in µm where their makers
// print them so.
#pragma once

#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace sahl {

struct ConstantIndex {
    double n;
};
/// n(λ) = max(n_d + (n_d − 1)/V_d · (523655/λ² − 1.5168), 1), λ in nm         (KHR_materials_dispersion)
struct AbbeIndex {
    double nd, vd;
};
/// n² = 1 + a + Σ B_i λ²/(λ² − C_i), C_i in µm²                                (makers' data sheets; formula
/// 2)
struct Sellmeier {
    std::vector<double> b, c_um2;
    double a = 0.0;
};
/// n = A + B/λ² + C/λ⁴
struct Cauchy {
    double a, b_um2, c_um4;
};
/// n² = c1 + Σ c_i λ^e_i                                                       (formula 3)
struct PowerSeries {
    double c1;
    std::vector<std::pair<double, double>> terms; // coefficient, exponent
};
/// n² = c1 + Σ b_i λ^e_i/(λ² − g_i) + Σ a_i λ^f_i                              (formula 4; handbooks of
/// optics)
struct PolesAndPowers {
    struct Pole {
        double b, exponent, g; // g in µm²
    };
    double c1;
    std::vector<Pole> poles;
    std::vector<std::pair<double, double>> powers; // coefficient, exponent
};
/// n = c1 + h1 L + h2 L² + Σ a_i λ^f_i, L = 1/(λ² − 0.028)                     (formulas 5, 7; Conrady,
/// Herzberger)
struct IndexSeries {
    double c1, h1, h2;
    std::vector<std::pair<double, double>> powers; // coefficient, exponent
};
/// (n² − 1)/(n² + 2) = c1 + c2 λ²/(λ² − c3) + c4 λ²                            (formula 8)
struct LorentzLorenz {
    double c1, c2, c3, c4;
};
/// n² = c1 + c2/(λ² − c3) + c4 (λ − c5)/((λ − c5)² + c6)                       (formula 9)
struct ResonantIndex {
    double c1, c2, c3, c4, c5, c6;
};
/// n − 1 = c1 + Σ c_i/(d_i − λ⁻²), absolute; divided by the index of air      (formula 6, gases)
struct GasIndex {
    double c1;
    std::vector<std::pair<double, double>> terms;
};
/// The index of vacuum relative to air: 1/n_air(λ).
struct VacuumIndex {};
struct AnyDispersion;
/// Another formula's index that its source gives relative to vacuum, divided by the index of air; its
/// wavelengths are those in vacuum where the source says so.
struct AbsoluteIndex {
    std::shared_ptr<AnyDispersion const> of; // not null
    bool index_is_absolute = true;
    bool wavelength_is_vacuum = true;
};
/// Linear in between, constant beyond the ends.
struct TabulatedIndex {
    std::vector<std::pair<double, double>> points; // wavelength in m, ascending; n
};

using Dispersion =
    std::variant<ConstantIndex, AbbeIndex, Sellmeier, Cauchy, PowerSeries, PolesAndPowers, IndexSeries,
                 LorentzLorenz, ResonantIndex, GasIndex, VacuumIndex, AbsoluteIndex, TabulatedIndex>;
struct AnyDispersion {
    Dispersion formula;
};

/// wavelength > 0 in m. Returns n relative to air; NaN where the formula has no real value.
double refractive_index(Dispersion const& dispersion, double wavelength);

/// True unless the index is the same at all wavelengths.
bool disperses(Dispersion const& dispersion);

} // namespace sahl

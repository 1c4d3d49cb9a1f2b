// In: a wavelength. Out: the refractive index. One overload a formula; the formulas stand at their types.
#include "materials/dispersion.h"

#include "materials/interpolate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sahl {
namespace {

constexpr double metres_to_um = 1e6;
constexpr double metres_to_nm = 1e9;
constexpr double herzberger_pole_um2 = 0.028; // M. Herzberger's constant, the same for all glasses

/// The root of n², NaN unless n² is positive and finite: at a resonance, and between it and where n² is
/// positive again.
double index_from_square(double n_squared) {
    bool const real = n_squared > 0.0 && std::isfinite(n_squared);
    return real ? std::sqrt(n_squared) : std::numeric_limits<double>::quiet_NaN();
}

/// n − 1 = c1 + Σ c_i/(d_i − λ⁻²), λ in µm.
double gas_refractivity(double c1, std::vector<std::pair<double, double>> const& terms, double wavelength) {
    double const um = wavelength * metres_to_um;
    double sum = c1;
    for (auto const& [c, d] : terms)
        sum += c / (d - 1.0 / (um * um));
    return sum;
}

/// Standard air: 15 °C, 101 325 Pa, dry, 450 ppm of CO₂ (P. E. Ciddor, Appl. Opt. 35 (1996) 1566, equation
/// 1). The formula asks for the wavelength in vacuum; that in air in its place changes n by less than 5e-9.
double index_of_air(double wavelength) {
    static std::vector<std::pair<double, double>> const terms{{0.05792105, 238.0185}, {0.00167917, 57.362}};
    return 1.0 + gas_refractivity(0.0, terms, wavelength);
}

/// Σ c λ^e, λ in µm.
double sum_of_powers(std::vector<std::pair<double, double>> const& terms, double um) {
    double sum = 0.0;
    for (auto const& [c, exponent] : terms)
        sum += c * std::pow(um, exponent);
    return sum;
}

struct IndexAt {
    double wavelength;

    double operator()(ConstantIndex const& f) const { return f.n; }
    double operator()(AbbeIndex const& f) const {
        double const nm = wavelength * metres_to_nm;
        return std::max(f.nd + (f.nd - 1.0) / f.vd * (523655.0 / (nm * nm) - 1.5168), 1.0);
    }
    double operator()(Sellmeier const& f) const {
        double const um = wavelength * metres_to_um;
        double sum = 1.0 + f.a;
        for (std::size_t i = 0; i < f.b.size(); ++i)
            sum += f.b[i] * um * um / (um * um - f.c_um2[i]);
        return index_from_square(sum);
    }
    double operator()(Cauchy const& f) const {
        double const um = wavelength * metres_to_um;
        return f.a + f.b_um2 / (um * um) + f.c_um4 / (um * um * um * um);
    }
    double operator()(PowerSeries const& f) const {
        return index_from_square(f.c1 + sum_of_powers(f.terms, wavelength * metres_to_um));
    }
    double operator()(PolesAndPowers const& f) const {
        double const um = wavelength * metres_to_um;
        double sum = f.c1 + sum_of_powers(f.powers, um);
        for (auto const& [b, exponent, g] : f.poles)
            sum += b * std::pow(um, exponent) / (um * um - g);
        return index_from_square(sum);
    }
    double operator()(IndexSeries const& f) const {
        double const um = wavelength * metres_to_um;
        double const l = 1.0 / (um * um - herzberger_pole_um2);
        return f.c1 + l * (f.h1 + l * f.h2) + sum_of_powers(f.powers, um);
    }
    double operator()(LorentzLorenz const& f) const {
        double const square = wavelength * metres_to_um * wavelength * metres_to_um;
        double const x = f.c1 + f.c2 * square / (square - f.c3) + f.c4 * square;
        return index_from_square((1.0 + 2.0 * x) / (1.0 - x));
    }
    double operator()(ResonantIndex const& f) const {
        double const um = wavelength * metres_to_um, off = um - f.c5;
        return index_from_square(f.c1 + f.c2 / (um * um - f.c3) + f.c4 * off / (off * off + f.c6));
    }
    double operator()(GasIndex const& f) const {
        return (1.0 + gas_refractivity(f.c1, f.terms, wavelength)) / index_of_air(wavelength);
    }
    double operator()(VacuumIndex const&) const { return 1.0 / index_of_air(wavelength); }
    double operator()(AbsoluteIndex const& f) const {
        double const air = index_of_air(wavelength);
        double const n =
            refractive_index(f.of->formula, f.wavelength_is_vacuum ? wavelength * air : wavelength);
        return f.index_is_absolute ? n / air : n;
    }
    double operator()(TabulatedIndex const& f) const {
        return interpolate(
            f.points, wavelength, [](auto const& p) { return p.first; },
            [](auto const& p) { return p.second; });
    }
};

struct Disperses {
    bool operator()(ConstantIndex const&) const { return false; }
    bool operator()(AbbeIndex const& f) const { return f.nd != 1.0 && std::isfinite(f.vd); }
    bool operator()(Sellmeier const& f) const {
        for (std::size_t i = 0; i < f.b.size(); ++i)
            if (f.b[i] != 0.0 && f.c_um2[i] != 0.0)
                return true;
        return false;
    }
    bool operator()(Cauchy const& f) const { return f.b_um2 != 0.0 || f.c_um4 != 0.0; }
    static bool any(std::vector<std::pair<double, double>> const& powers) {
        return std::any_of(powers.begin(), powers.end(),
                           [](auto const& term) { return term.first != 0.0 && term.second != 0.0; });
    }
    bool operator()(PowerSeries const& f) const { return any(f.terms); }
    bool operator()(PolesAndPowers const& f) const { return !f.poles.empty() || any(f.powers); }
    bool operator()(IndexSeries const& f) const { return f.h1 != 0.0 || f.h2 != 0.0 || any(f.powers); }
    bool operator()(LorentzLorenz const& f) const { return f.c4 != 0.0 || (f.c2 != 0.0 && f.c3 != 0.0); }
    bool operator()(ResonantIndex const& f) const { return f.c2 != 0.0 || f.c4 != 0.0; }
    bool operator()(GasIndex const&) const { return true; } // air, which it is divided by, disperses
    bool operator()(VacuumIndex const&) const { return true; }
    bool operator()(AbsoluteIndex const& f) const { return f.index_is_absolute || disperses(f.of->formula); }
    bool operator()(TabulatedIndex const& f) const {
        return std::any_of(f.points.begin(), f.points.end(),
                           [&](auto const& point) { return point.second != f.points.front().second; });
    }
};

} // namespace

double refractive_index(Dispersion const& dispersion, double wavelength) {
    return std::visit(IndexAt{wavelength}, dispersion);
}

bool disperses(Dispersion const& dispersion) {
    return std::visit(Disperses{}, dispersion);
}

} // namespace sahl

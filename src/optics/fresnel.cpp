#include "optics/fresnel.h"

namespace sahl {

using Complex = std::complex<double>;

namespace {

/// |a − b|² / |a + b|², where a² − b² is known without cancellation.
double reflected_share(Complex a, Complex b, Complex difference_of_squares) {
    double const sum = std::norm(a + b);
    double const direct = std::norm(a - b) / sum;
    return direct < 0.0625 ? std::norm(difference_of_squares) / (sum * sum) : direct;
}

} // namespace

FresnelShares fresnel_metal(Incidence incidence, double n_incident, std::complex<double> metal) {
    auto const [c, s] = incidence;
    double const n = metal.real() / n_incident, k = metal.imag() / n_incident;
    Complex const epsilon{(n - k) * (n + k), 2.0 * n * k};
    // 1 − ε, the real part as k² − (n − 1)(n + 1), and n − 1 from the indices themselves, which may nearly
    // match
    double const above = (metal.real() - n_incident) / n_incident;
    Complex const one_less{std::fma(k, k, -above * (n + 1.0)), -epsilon.imag()};
    // q² = ε − sin² = cos² − (1 − ε): whichever takes the smaller number away
    Complex const q = std::sqrt(
        Complex{c >= s ? difference_of_products(n - k, n + k, s, s) : std::fma(c, c, -one_less.real()),
                epsilon.imag()});
    // (εc)² − q² = (ε − 1)(ε cos² − sin²)
    Complex const turning{difference_of_products(epsilon.real() * c, c, s, s), epsilon.imag() * c * c};
    return {reflected_share(c, q, one_less), reflected_share(epsilon * c, q, -one_less * turning),
            4.0 * c * q.real() / std::norm(c + q),
            4.0 * c * (std::conj(epsilon) * q).real() / std::norm(epsilon * c + q)};
}

} // namespace sahl

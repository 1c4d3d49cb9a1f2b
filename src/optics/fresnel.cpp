#include "optics/fresnel.h"

namespace sahl {

FresnelShares fresnel_metal(Incidence incidence, double n_incident, std::complex<double> metal) {
    double const c = incidence.cosine;
    double const n = metal.real() / n_incident, k = metal.imag() / n_incident;
    std::complex<double> const epsilon{(n - k) * (n + k), 2.0 * n * k};
    // ε − sin² with its real part formed as (n − 1)(n + 1) − k² + cos²
    std::complex<double> const q =
        std::sqrt(std::complex<double>{(n - 1.0) * (n + 1.0) - k * k + c * c, epsilon.imag()});
    std::complex<double> const sum_s = c + q, sum_p = epsilon * c + q;
    return {std::norm((c - q) / sum_s), std::norm((epsilon * c - q) / sum_p),
            4.0 * c * q.real() / std::norm(sum_s),
            4.0 * c * (std::conj(epsilon) * q).real() / std::norm(sum_p)};
}

} // namespace sahl

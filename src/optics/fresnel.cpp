#include "optics/fresnel.h"

#include <cmath>

namespace sahl {

namespace {

/// a·b − c·d with one rounding's worth of error (W. Kahan; see Jeannerod, Louvet, Muller, Math. Comp. 82 (2013) 2245).
double difference_of_products(double a, double b, double c, double d) {
    double const cd = c * d;
    double const error = std::fma(-c, d, cd);
    return std::fma(a, b, -cd) + error;
}

} // namespace

double transmitted_normal_squared(Incidence incidence, double n_incident, double n_transmitted) {
    auto const [cosine, sine] = incidence;
    if (cosine >= sine) // small angles: n_t ± n_i sin are formed with one rounding each
        return std::fma(-n_incident, sine, n_transmitted) * std::fma(n_incident, sine, n_transmitted);
    // near grazing: n_t² − n_i² + (n_i cos)²
    double const along = n_incident * cosine;
    double const along_error = std::fma(n_incident, cosine, -along);
    double const indices = (n_transmitted - n_incident) * (n_transmitted + n_incident);
    return std::fma(along, along, indices) + 2.0 * along * along_error;
}

std::optional<FresnelShares> fresnel_dielectric(Incidence incidence, double n_incident, double n_transmitted) {
    double const k2_squared = transmitted_normal_squared(incidence, n_incident, n_transmitted);
    if (k2_squared <= 0.0)
        return std::nullopt;
    auto const [c, s] = incidence;
    double const n1 = n_incident, n2 = n_transmitted;
    double const n1_squared = n1 * n1, n2_squared = n2 * n2;
    double const k1 = n1 * c;
    double const k2 = std::sqrt(k2_squared);
    double const indices = (n2 - n1) * (n2 + n1);
    double const sum_s = k1 + k2;
    double const sum_p = n2_squared * k1 + n1_squared * k2;
    double const amplitude_s = indices / (sum_s * sum_s);
    double const amplitude_p = indices * n1_squared * difference_of_products(n2, c, n1, s) * std::fma(n2, c, n1 * s) /
                               (sum_p * sum_p);
    double const both = 4.0 * k1 * k2;
    return FresnelShares{amplitude_s * amplitude_s, amplitude_p * amplitude_p, both / (sum_s * sum_s),
                         both * n1_squared * n2_squared / (sum_p * sum_p)};
}

FresnelShares fresnel_metal(Incidence incidence, double n_incident, std::complex<double> metal) {
    auto const [c, s] = incidence;
    double const n = metal.real() / n_incident, k = metal.imag() / n_incident;
    std::complex<double> const epsilon{(n - k) * (n + k), 2.0 * n * k};
    // ε − sin² with its real part formed as (n − 1)(n + 1) − k² + cos²
    std::complex<double> const q = std::sqrt(std::complex<double>{(n - 1.0) * (n + 1.0) - k * k + c * c, epsilon.imag()});
    std::complex<double> const sum_s = c + q, sum_p = epsilon * c + q;
    return {std::norm((c - q) / sum_s), std::norm((epsilon * c - q) / sum_p), 4.0 * c * q.real() / std::norm(sum_s),
            4.0 * c * (std::conj(epsilon) * q).real() / std::norm(sum_p)};
}

} // namespace sahl

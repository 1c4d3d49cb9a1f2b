// In: angles and indices in double. Out: Fresnel's shares from them in arithmetic of 113 bits, straight from
// the textbook: the judge of the tests.
#pragma once

#include "optics/fresnel.h"

#include <cmath>
#include <complex>
#include <optional>

namespace sahl::bench {

__extension__ using Quad = __float128;

inline Quad absolute_of(Quad x) {
    return x < 0 ? -x : x;
}

/// Newton's method from the root in double; two steps reach 113 bits.
inline Quad root_of(Quad x) {
    if (x <= 0)
        return 0;
    int exponent = 0; // numbers may lie below the range of double
    while (x < 1e-300) {
        x *= Quad(0x1p200);
        ++exponent;
    }
    Quad root = std::sqrt(static_cast<double>(x));
    for (int step = 0; step < 3; ++step)
        root = (root + x / root) / 2;
    while (exponent-- > 0)
        root *= Quad(0x1p-100);
    return root;
}

/// The angle that a pair of rounded numbers means: the smaller of the two has the digits.
struct ExactIncidence {
    Quad cosine, sine;
    explicit ExactIncidence(Incidence incidence) : cosine(incidence.cosine), sine(incidence.sine) {
        if (cosine >= sine)
            cosine = root_of(1 - sine * sine);
        else
            sine = root_of(1 - cosine * cosine);
    }
};

struct ExactShares {
    Quad r_s, r_p, t_s, t_p;
};

/// Born and Wolf, 1.5.2 (20), (21), (35). Nothing under total internal reflection.
inline std::optional<ExactShares> exact_fresnel(Incidence incidence, double n_incident,
                                                double n_transmitted) {
    ExactIncidence const at(incidence);
    Quad const n1 = n_incident, n2 = n_transmitted;
    Quad const squared = incidence.cosine >= incidence.sine
                             ? (n2 - n1 * at.sine) * (n2 + n1 * at.sine)
                             : (n2 - n1) * (n2 + n1) + n1 * n1 * at.cosine * at.cosine;
    if (squared <= 0)
        return std::nullopt;
    Quad const k1 = n1 * at.cosine, k2 = root_of(squared); // n cos
    Quad const s = (k1 - k2) / (k1 + k2), sum_p = n2 * n2 * k1 + n1 * n1 * k2,
               p = (n2 * n2 * k1 - n1 * n1 * k2) / sum_p;
    return ExactShares{s * s, p * p, 4 * k1 * k2 / ((k1 + k2) * (k1 + k2)),
                       4 * n1 * n1 * n2 * n2 * k1 * k2 / (sum_p * sum_p)};
}

/// Born and Wolf, 14.2, with q² = ε − sin²; ε relative to the medium in front.
inline ExactShares exact_metal(Incidence incidence, double n_incident, std::complex<double> metal) {
    ExactIncidence const at(incidence);
    Quad const n = Quad(metal.real()) / n_incident, k = Quad(metal.imag()) / n_incident, c = at.cosine;
    Quad const e_re = n * n - k * k, e_im = 2 * n * k;
    Quad const re = e_re - at.sine * at.sine, size = root_of(re * re + e_im * e_im);
    // the root with both parts ≥ 0, the larger from the sum and the smaller from the product
    Quad const larger = root_of((size + absolute_of(re)) / 2);
    Quad const smaller = larger > 0 ? e_im / (2 * larger) : Quad(0);
    Quad const q_re = re >= 0 ? larger : smaller, q_im = re >= 0 ? smaller : larger;
    auto const norm = [](Quad a, Quad b) { return a * a + b * b; };
    Quad const below_s = norm(c + q_re, q_im), below_p = norm(e_re * c + q_re, e_im * c + q_im);
    return {norm(c - q_re, q_im) / below_s, norm(e_re * c - q_re, e_im * c - q_im) / below_p,
            4 * c * q_re / below_s, 4 * c * (e_re * q_re + e_im * q_im) / below_p};
}

} // namespace sahl::bench

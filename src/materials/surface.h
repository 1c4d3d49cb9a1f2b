// In: nothing. Out: what a face is finished with, as plain data.
#pragma once

#include <array>
#include <complex>
#include <string>
#include <variant>
#include <vector>

namespace sahl {

/// A smooth metal, complex index n + ik relative to air.
struct Metal {
    struct Point {
        double wavelength; // m
        double n, k;
    };
    std::vector<Point>
        table; // ascending; one point: the same at all wavelengths; linear in between, constant beyond
};
/// Constant shares; the rest is absorbed. Directions by Snell; where refraction is impossible the transmitted
/// share reflects.
struct Shares {
    double reflect = 0.0, transmit = 0.0; // each ≥ 0, sum ≤ 1
};
struct Absorber {};
/// Lambertian reflector.
struct Diffuse {
    double reflectance = 0.0; // [0, 1]
};
/// For pictures; in tracing it reflects its share like a mirror and absorbs the rest.
struct Paint {
    std::array<double, 3> ambient{0, 0, 0}, diffuse{0, 0, 0}, specular{0, 0, 0};
    double shininess = 1.0, reflect = 0.0;
    std::string texture;
};

struct Surface {
    std::string name;
    std::variant<Metal, Shares, Absorber, Diffuse, Paint> kind = Absorber{};
};

/// n + ik of a metal at `wavelength` (m).
std::complex<double> complex_index(Metal const& metal, double wavelength);

} // namespace sahl

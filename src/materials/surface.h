// In: nothing. Out: what a face is finished with, as plain data.
#pragma once

#include "materials/colour.h"
#include "math/ids.h"

#include <array>
#include <complex>
#include <optional>
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
/// Cubes in turn, from the object's origin on.
struct Checker {
    double size = 1.0;     // m, in the object's frame
    Colour other{0, 0, 0}; // what ambient and diffuse are multiplied by in every second one
};
/// For pictures (B. T. Phong, Commun. ACM 18 (1975) 311); in tracing it reflects its share like a mirror and
/// absorbs the rest. Where it covers less than all, the other share goes on by Snell, which between equal
/// media is straight.
struct Paint {
    Colour ambient{0, 0, 0}, diffuse{0, 0, 0}, specular{0, 0, 0};
    double shininess = 1.0, reflect = 0.0;
    std::string texture; // file of a picture that multiplies ambient and diffuse, or empty
    std::optional<Checker> checker{};
    double covers = 1.0; // [0, 1]: of the surface
};

/// A boundary as model files describe it: of what arrives, `clear` meets the boundary of the two media, and
/// what refracts there is tinted; `mirrored` is reflected like a mirror beside it. The rest is absorbed.
struct Tinted {
    double clear = 1.0;                // [0, 1]
    Colour transmitted{1.0, 1.0, 1.0}; // share of the refracted light that goes on
    Colour mirrored{0.0, 0.0, 0.0};    // clear + mirrored ≤ 1 for each
};
/// A plane plate without thickness: light that is reflected to and fro in it comes out at the same place, in
/// the direction in which it came.
struct ThinWall {
    MediumId wall;                     // what the plate is made of
    double clear = 1.0;                // as of Tinted
    Colour transmitted{1.0, 1.0, 1.0}; // share of what comes through that goes on
    Colour mirrored{0.0, 0.0, 0.0};
};

struct Surface {
    std::string name;
    std::variant<Metal, Shares, Absorber, Diffuse, Paint, Tinted, ThinWall> kind = Absorber{};
    std::optional<TextureId> texture{}; // in pictures its colour is times that of this one
};

/// n + ik of a metal at `wavelength` (m).
std::complex<double> complex_index(Metal const& metal, double wavelength);

} // namespace sahl

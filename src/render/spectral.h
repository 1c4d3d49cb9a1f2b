// In: how many wavelengths a sample is traced at. Out: which, and what each adds to red, green and blue.
#pragma once

#include "math/vec.h"

#include <cstdint>
#include <vector>

namespace sahl {

/// Linear sRGB (IEC 61966-2-1) of tristimulus values; outside the gamut a number is negative.
dvec3 linear_srgb(dvec3 const& xyz);

/// White light cut into narrow lines: where paint, lamps and sky have three numbers, a number holds over its
/// band (materials/colour.h), and the sum of all lines' matrices is the identity, so that what does not
/// disperse has the colour it has without wavelengths.
class Spectrum {
  public:
    /// lines   that the visible range is cut into; a sample takes some of them
    explicit Spectrum(std::uint32_t lines);

    std::vector<double> const& wavelengths() const { return wavelengths_; } // m

    /// A few lines that stand for all: `count` of them, spread evenly, shifted by `turn` in [0, 1).
    struct Line {
        std::uint32_t line;
        dmat3 colour; // from the three numbers of what is seen to linear sRGB
    };
    std::vector<Line> sample(std::uint32_t count, double turn) const;

  private:
    std::vector<double> wavelengths_;
    std::vector<dmat3> colours_; // of each line
};

} // namespace sahl

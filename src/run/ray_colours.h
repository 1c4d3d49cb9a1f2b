// In: the pieces of a log. Out: a colour for each end of each, as model files have them.
#pragma once

#include "trace/segment.h"

#include <array>
#include <cstdint>
#include <utility>

namespace sahl {

enum class ColourBy { wavelength, power, depth };

/// Every piece is shown to it first: power and depth need the greatest of all.
class RayColours {
  public:
    using Bytes = std::array<std::uint8_t, 4>; // linear red, green, blue, and coverage

    explicit RayColours(ColourBy by) : by_(by) {}
    void look_at(Segment const& segment);
    /// At its start and at its end.
    std::pair<Bytes, Bytes> of(Segment const& segment) const;

  private:
    Bytes of_power(double watts) const;

    ColourBy by_;
    double most_power_ = 0.0; // W
    unsigned deepest_ = 0;
};

} // namespace sahl

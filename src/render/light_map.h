// In: light that reached a detector. Out: what it adds to the paint that the detector lies on.
#pragma once

#include "math/vec.h"

#include <cstdint>
#include <vector>

namespace sahl {

/// A point lies on a rectangle if it is nearer than this share of its size: paint and detector are placed by
/// numbers that a person wrote.
inline constexpr double on_rectangle = 1e-4;

/// Light over a rectangle: in units of what makes white paint show 1.
class LightMap {
  public:
    /// to_world   of the rectangle z = 0, x along its columns, y up its rows: rigid; size   m
    LightMap(Affine const& to_world, dvec2 const& size, std::uint32_t columns, std::uint32_t rows)
        : to_own_(inverse(to_world)), size_(size), columns_(columns), rows_(rows),
          light_(std::size_t{columns} * rows, dvec3(0.0)) {}

    /// at   m, from the rectangle's middle along x and y
    void add(dvec2 const& at, dvec3 const& light);
    /// Linear between pixels' middles; 0 for a point that is not on the rectangle.
    dvec3 at(dvec3 const& point) const;

  private:
    dvec3 pixel(double x, double y) const;

    Affine to_own_;
    dvec2 size_;
    std::uint32_t columns_, rows_;
    std::vector<dvec3> light_;
};

} // namespace sahl

// In: an open flat shape and a line in its frame. Out: where the line crosses it, from the shape's
// definition.
#pragma once

#include "geometry/shape.h"
#include "torture/wide.h"

#include <optional>

namespace sahl::bench {

/// A rectangle or a disk at z = 0.
template <class T>
class ExactSheet {
  public:
    explicit ExactSheet(Shape const& shape) {
        if (auto const* const rectangle = std::get_if<Rectangle>(&shape))
            half_ = {T(rectangle->size.x) / 2, T(rectangle->size.y) / 2, 0};
        else
            radius_ = T(std::get<Disk>(shape).radius), hole_ = T(std::get<Disk>(shape).hole_radius);
    }
    std::optional<T> meet(Wide3<T> const& origin, Wide3<T> const& direction) const {
        if (direction.z == 0)
            return std::nullopt;
        T const t = -origin.z / direction.z, x = origin.x + t * direction.x, y = origin.y + t * direction.y;
        T const squared = x * x + y * y;
        bool const on = radius_ > 0 ? squared < radius_ * radius_ && squared >= hole_ * hole_
                                    : absolute_of(x) < half_.x && absolute_of(y) < half_.y;
        return on ? std::optional(t) : std::nullopt;
    }
    double extent() const { return static_cast<double>(radius_ > 0 ? radius_ : length(half_)); }

  private:
    Wide3<T> half_;
    T radius_ = 0, hole_ = 0;
};

} // namespace sahl::bench

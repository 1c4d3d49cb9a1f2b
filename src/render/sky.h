// In: a background. Out: the light that comes from a direction in which nothing is.
#pragma once

#include "image/environment.h"
#include "scene/picture.h"

#include <optional>

namespace sahl {

class Sky {
  public:
    /// Reads the image where there is one. Throws InputError.
    explicit Sky(Background const& background);
    /// direction   unit, away from the scene
    /// across, down   how the direction changes over what a sample stands for; zero: a point
    dvec3 toward(dvec3 const& direction, dvec3 const& across = dvec3(0.0),
                 dvec3 const& down = dvec3(0.0)) const;
    bool has_image() const { return environment_.has_value(); }

  private:
    Background background_;
    std::optional<Environment> environment_;
};

} // namespace sahl

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
    dvec3 toward(dvec3 const& direction) const;

  private:
    Background background_;
    std::optional<Environment> environment_;
};

} // namespace sahl

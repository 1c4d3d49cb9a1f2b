// In: a background. Out: the light that comes from a direction in which nothing is.
#pragma once

#include "scene/picture.h"

namespace sahl {

class Sky {
  public:
    /// Reads the image where there is one. Throws InputError.
    explicit Sky(Background const& background);
    /// direction   unit, away from the scene
    dvec3 toward(dvec3 const& direction) const;

  private:
    Background background_;
};

} // namespace sahl

// In: a picture of all directions. Out: what it shows in one of them.
#pragma once

#include "image/texture.h"

namespace sahl {

/// Light from infinitely far: a picture of twice as many columns as rows, longitude across and latitude up.
/// Its centre is seen along −z, its right half on the side of +x, its top row along +y, all in its own frame.
class Environment {
  public:
    /// to_own   from the world's frame to the picture's: orthonormal
    explicit Environment(Image const& image, dmat3 const& to_own = dmat3(1.0))
        : texture_(image, Wrap::repeat, Wrap::clamp), to_own_(to_own) {}

    /// The light that comes from there, linear RGB.
    /// direction   unit, in the world, away from the eye
    /// dx, dy      how it changes over the footprint; zero: a point
    dvec3 at(dvec3 const& direction, dvec3 const& dx = dvec3(0.0), dvec3 const& dy = dvec3(0.0)) const;

    /// Where on the picture, from the left and from the bottom, a direction of its own frame lies.
    static dvec2 place_of(dvec3 const& direction);

  private:
    Texture texture_;
    dmat3 to_own_;
};

} // namespace sahl

// The start is moved along the normal out of the box that bounds the hit point's rounding (M. Pharr, W.
// Jakob, G. Humphreys, Physically Based Rendering, 4th ed., 6.8.6: OffsetRayOrigin).
#include "float_finder.h"

#include <cmath>

namespace sahl::bench {

namespace {

class ErrorBoundOffset : public FloatFinder {
  public:
    using FloatFinder::FloatFinder;

  protected:
    fvec3 start(FloatScene::Hit const& hit, fvec3 const& direction) const override {
        float const distance = dot(glm::abs(hit.normal), hit.error);
        fvec3 const offset = (dot(hit.normal, direction) < 0.0f ? -distance : distance) * hit.normal;
        fvec3 at = hit.point + offset;
        for (int axis = 0; axis < 3; ++axis) // rounded away from the surface
            if (offset[axis] != 0.0f)
                at[axis] = std::nextafter(at[axis], offset[axis] > 0.0f ? INFINITY : -INFINITY);
        return at;
    }
};

} // namespace

std::unique_ptr<Finder> error_bound_offset(TortureCase const& torture) {
    return std::make_unique<ErrorBoundOffset>(torture);
}

} // namespace sahl::bench

// Hits nearer than a distance in proportion to the largest coordinate of the start do not count: 1500 · 2⁻²⁴
// of it, the number that Mitsuba calls RayEpsilon (there of 1 plus that coordinate).
#include "float_finder.h"

#include <algorithm>

namespace sahl::bench {

namespace {

class RelativeEpsilon : public FloatFinder {
  public:
    using FloatFinder::FloatFinder;

  protected:
    float from() const override {
        fvec3 const size = glm::abs(origin_);
        return 1500.0f * 0x1p-24f * std::max({size.x, size.y, size.z});
    }
};

} // namespace

std::unique_ptr<Finder> relative_epsilon(TortureCase const& torture) {
    return std::make_unique<RelativeEpsilon>(torture);
}

} // namespace sahl::bench

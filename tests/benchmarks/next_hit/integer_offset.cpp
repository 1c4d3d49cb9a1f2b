// The start is moved along the normal by 256 steps of its coordinates' own last place (C. Wächter, N. Binder,
// A Fast and Robust Method for Avoiding Self-Intersection, Ray Tracing Gems (2019), chapter 6).
#include "float_finder.h"

#include <bit>
#include <cmath>

namespace sahl::bench {

namespace {

constexpr float near_origin = 1.0f / 32.0f, float_scale = 1.0f / 65536.0f, int_scale = 256.0f;

float moved(float p, float n) {
    int const steps = static_cast<int>(int_scale * n);
    float const stepped = std::bit_cast<float>(std::bit_cast<int>(p) + (p < 0.0f ? -steps : steps));
    return std::abs(p) < near_origin ? p + float_scale * n : stepped;
}

class IntegerOffset : public FloatFinder {
  public:
    using FloatFinder::FloatFinder;

  protected:
    fvec3 start(FloatScene::Hit const& hit, fvec3 const& direction) const override {
        fvec3 const n = dot(hit.normal, direction) < 0.0f ? -hit.normal : hit.normal;
        return {moved(hit.point.x, n.x), moved(hit.point.y, n.y), moved(hit.point.z, n.z)};
    }
};

} // namespace

std::unique_ptr<Finder> integer_offset(TortureCase const& torture) {
    return std::make_unique<IntegerOffset>(torture);
}

} // namespace sahl::bench

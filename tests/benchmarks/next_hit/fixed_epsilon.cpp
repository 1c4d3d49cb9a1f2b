// Hits nearer than a fixed distance do not count: 1e-4 of the scene's size, as it is often set by hand.
#include "float_finder.h"

namespace sahl::bench {

namespace {

class FixedEpsilon : public FloatFinder {
  public:
    using FloatFinder::FloatFinder;

  protected:
    float from() const override { return static_cast<float>(1e-4 * scene_.size()); }
};

} // namespace

std::unique_ptr<Finder> fixed_epsilon(TortureCase const& torture) {
    return std::make_unique<FixedEpsilon>(torture);
}

} // namespace sahl::bench

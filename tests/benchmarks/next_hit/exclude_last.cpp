// The triangle that the ray starts on is not met again: a filter knows its number.
#include "float_finder.h"

namespace sahl::bench {

namespace {

class ExcludeLast : public FloatFinder {
  public:
    using FloatFinder::FloatFinder;

  protected:
    bool excludes_last() const override { return true; }
};

} // namespace

std::unique_ptr<Finder> exclude_last(TortureCase const& torture) {
    return std::make_unique<ExcludeLast>(torture);
}

} // namespace sahl::bench

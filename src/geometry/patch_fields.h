// In: smooth fans and what their triangles' surfaces keep to. Out: polynomials by fan, fitted when first
// asked for, by any thread.
#pragma once

#include "geometry/patch_fit.h"
#include "geometry/patch_relief.h"

#include <atomic>
#include <memory>
#include <vector>

namespace sahl {

class LazyFields {
  public:
    explicit LazyFields(std::shared_ptr<SmoothFans const> fans);
    ~LazyFields();
    LazyFields(LazyFields const&) = delete;
    LazyFields& operator=(LazyFields const&) = delete;

    /// Nothing where no polynomial describes the surface there better than the quadratic patch.
    HeightField const* at(std::uint32_t fan, std::span<Relief const> reliefs) const {
        HeightField const* const known = slots_[fan].load(std::memory_order_acquire);
        return known == nullptr ? fit(fan, reliefs) : known == &none_ ? nullptr : known;
    }

  private:
    HeightField const* fit(std::uint32_t fan, std::span<Relief const> reliefs) const;
    std::shared_ptr<SmoothFans const> fans_;
    mutable std::vector<std::atomic<HeightField const*>> slots_;
    HeightField none_{};
};

} // namespace sahl

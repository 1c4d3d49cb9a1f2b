// In: boxes. Out: those that a line meets, roughly nearest first.
// Embree proposes in float; what is inside a box is decided in double by the visitor.
#pragma once

#include "geometry/embree/reach.h"
#include "math/vec.h"

#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

namespace sahl {

struct Bounds {
    dvec3 low{0.0}, high{0.0};
};

class BoxTree {
  public:
    explicit BoxTree(std::span<Bounds const> boxes);
    BoxTree(BoxTree&&) noexcept;
    BoxTree& operator=(BoxTree&&) noexcept;
    ~BoxTree();

    /// Calls visitor(index, to) for every box that the line may meet between reach.from and `to`, once each;
    /// it returns the new `to`, never a larger one. No box that the line meets in exact arithmetic is left
    /// out: boxes are grown by more than what rounding the line to float can move it. A line that is not
    /// finite meets nothing.
    template <class Visitor>
    void visit(dvec3 const& origin, dvec3 const& direction, Reach reach, Visitor&& visitor) const {
        using Plain = std::remove_reference_t<Visitor>;
        visit_boxes(
            origin, direction, reach,
            [](void* context, std::uint32_t index, double to) {
                return (*static_cast<Plain*>(context))(index, to);
            },
            const_cast<void*>(static_cast<void const*>(&visitor)));
    }

  private:
    using Callback = double (*)(void* context, std::uint32_t index, double to);
    void visit_boxes(dvec3 const& origin, dvec3 const& direction, Reach reach, Callback callback,
                     void* context) const;

    struct State;
    std::unique_ptr<State> state_;
};

} // namespace sahl

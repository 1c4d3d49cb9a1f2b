// In: triangles. Out: those that a line meets, roughly nearest first. Embree meets them in float, grown by
// more than its rounding: it proposes too many rather than too few, and the visitor decides in double.
#pragma once

#include "geometry/embree/reach.h"
#include "math/vec.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

namespace sahl {

/// A triangle that a line may meet, as far as float tells.
struct Proposal {
    std::uint32_t triangle = 0;
    double t = 0.0;
    int sense = 0; // sign of normal · direction (corners anticlockwise); 0: too close to 0 for float to tell
};

class TriangleTree {
  public:
    /// Below this slope the sign of normal · direction is left open: the float normal of a grown triangle,
    /// whose height is at least twice the growth, may be wrong by so much.
    static constexpr double sure_slope = 0.02;

    /// Corners anticlockwise, seen from where most lines come.
    ///   sure   the slope below which a proposal's sense is left open, if that is to be more than sure_slope
    explicit TriangleTree(std::span<std::array<dvec3, 3> const> triangles, double sure = sure_slope);
    TriangleTree(TriangleTree&&) noexcept;
    TriangleTree& operator=(TriangleTree&&) noexcept;
    ~TriangleTree();

    /// unit   length of the direction, which the caller has
    /// Calls visitor(Proposal) for the triangles that the line meets between reach.from and `to`; it returns
    /// the new `to`, below the last one, where it takes the triangle, and ∞ where it does not. What lies a
    /// little before reach.from or behind `to` may be proposed too.
    /// Left out are at most triangles that the line meets at less than 4e-3 rad, where Embree's t has no
    /// digits. A line that is not finite meets nothing.
    template <class Visitor>
    void visit(dvec3 const& origin, dvec3 const& direction, double unit, Reach reach,
               Visitor&& visitor) const {
        using Plain = std::remove_reference_t<Visitor>;
        visit_triangles(
            origin, direction, unit, reach,
            [](void* context, Proposal const& proposal) { return (*static_cast<Plain*>(context))(proposal); },
            const_cast<void*>(static_cast<void const*>(&visitor)));
    }

    static constexpr std::size_t most_together = 16;
    /// Lines from their starts on, coordinate by coordinate, so that all are made ready at once. Those beyond
    /// `count` have any numbers.
    struct Lines {
        using Numbers = std::array<double, most_together>;
        std::size_t count = 0;
        alignas(64) std::array<Numbers, 3> origin, direction;
        alignas(64) Numbers unit; // lengths of the directions

        void add(dvec3 const& start, dvec3 const& along, double length) {
            for (int axis = 0; axis < 3; ++axis) {
                origin[static_cast<std::size_t>(axis)][count] = start[axis];
                direction[static_cast<std::size_t>(axis)][count] = along[axis];
            }
            unit[count++] = length;
        }
        dvec3 start(std::size_t i) const { return {origin[0][i], origin[1][i], origin[2][i]}; }
        dvec3 along(std::size_t i) const { return {direction[0][i], direction[1][i], direction[2][i]}; }
    };
    /// Can lines be asked about together? Not with an Embree that was built without packets.
    bool visits_together() const;
    /// visit() for lines that go much the same way, from 0 to ∞: quicker than one by one. Calls
    /// visitor(number, Proposal), the number being that of the line.
    template <class Visitor>
    void visit_together(Lines const& lines, Visitor&& visitor) const {
        using Plain = std::remove_reference_t<Visitor>;
        visit_packet(
            lines,
            [](void* context, std::size_t line, Proposal const& proposal) {
                return (*static_cast<Plain*>(context))(line, proposal);
            },
            const_cast<void*>(static_cast<void const*>(&visitor)));
    }

    /// visit() for lines one after another, from 0 to ∞: made ready together, that costs less than one by
    /// one. Calls begin(number) before a line's proposals, and not for lines that meet nothing for certain.
    template <class Begin, class Visitor>
    void visit_in_turn(Lines const& lines, Begin&& begin, Visitor&& visitor) const {
        struct Both {
            Begin& begin;
            Visitor& visitor;
            std::size_t line;
        } both{begin, visitor, 0};
        visit_lines(
            lines,
            [](void* context, std::size_t line) {
                Both& of = *static_cast<Both*>(context);
                of.begin(of.line = line);
            },
            [](void* context, Proposal const& proposal) {
                Both const& of = *static_cast<Both*>(context);
                return of.visitor(of.line, proposal);
            },
            &both);
    }

    /// m: how far along the line a proposal of sure sense may lie from where its t says.
    double blur() const;
    /// m: how far from a triangle's plane, on the outer side, a line may start and pass for one that starts
    /// behind it.
    double lift() const;

  private:
    using Callback = double (*)(void* context, Proposal const& proposal);
    void visit_triangles(dvec3 const& origin, dvec3 const& direction, double unit, Reach reach,
                         Callback callback, void* context) const;
    using PacketCallback = double (*)(void* context, std::size_t line, Proposal const& proposal);
    void visit_packet(Lines const& lines, PacketCallback callback, void* context) const;
    using Beginning = void (*)(void* context, std::size_t line);
    void visit_lines(Lines const& lines, Beginning begin, Callback callback, void* context) const;

    struct State;
    std::unique_ptr<State> state_;
};

} // namespace sahl

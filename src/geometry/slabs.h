// In: a line and boxes. Out: which of them it meets, as far as rounding tells.
#pragma once

#include "geometry/embree/box_tree.h"
#include "math/vec.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace sahl {

/// Four numbers in one register.
using Lanes [[gnu::vector_size(32)]] = double;
using LaneBits [[gnu::vector_size(32)]] = std::int64_t; // what comparing them gives

constexpr std::size_t boxes_at_once = 4;

/// Boxes, one in each lane, grown by a share of their sizes that is far above rounding. Lanes that are not
/// set are met by no line.
struct BoxRow {
    std::array<Lanes, 3> low, high; // by axis
    BoxRow() {
        for (std::array<Lanes, 3>* const ends : {&low, &high})
            ends->fill(Lanes{INFINITY, INFINITY, INFINITY, INFINITY});
    }
    void set(int lane, Bounds const& box) {
        dvec3 const size = box.high - box.low;
        double const room = 1e-12 * (size.x + size.y + size.z);
        for (int axis = 0; axis < 3; ++axis) {
            low[static_cast<std::size_t>(axis)][lane] = box.low[axis] - room;
            high[static_cast<std::size_t>(axis)][lane] = box.high[axis] + room;
        }
    }
};

/// A line made ready for boxes.
struct Slabs {
    dvec3 origin, per_metre; // 1/direction
    double margin;           // far above rounding

    Slabs(dvec3 const& from, dvec3 const& direction)
        : origin(from), per_metre(1.0 / direction),
          margin(1e-12 * (std::abs(from.x) + std::abs(from.y) + std::abs(from.z))) {}

    /// Writes t where the line enters each box, or `from`, if it starts inside; returns a bit for each that
    /// it meets before `to`.
    std::uint32_t entries(BoxRow const& boxes, double from, double to, double* entry) const {
        Lanes enters{from, from, from, from}, leaves{to, to, to, to};
        for (int axis = 0; axis < 3; ++axis) {
            auto const a = static_cast<std::size_t>(axis);
            Lanes const one = (boxes.low[a] - margin - origin[axis]) * per_metre[axis];
            Lanes const other = (boxes.high[a] + margin - origin[axis]) * per_metre[axis];
            // comparisons with 0/0 are false: it constrains nothing
            Lanes const near = one < other ? one : other, far = one < other ? other : one;
            enters = near > enters ? near : enters;
            leaves = far < leaves ? far : leaves;
        }
        std::memcpy(entry, &enters, sizeof enters);
        LaneBits const met = (enters <= leaves) & LaneBits{1, 2, 4, 8};
        return static_cast<std::uint32_t>(met[0] | met[1] | met[2] | met[3]);
    }
};

} // namespace sahl

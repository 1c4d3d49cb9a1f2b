// In: nothing. Out: ways to meet a mesh that only pilot rays use, to tell how far the others can be trusted.
#pragma once

#include "geometry/bvh.h"

namespace sahl {

/// The fitted surface with the normals of each place taken from the polynomials of the farther corners.
inline constexpr Curving fitted_apart{16};
/// Recognised from half of the vertices alone, and from the rest; the same by other halves.
inline constexpr Curving recognised_even{17};
inline constexpr Curving recognised_odd{18};
inline constexpr Curving recognised_heads{19};
inline constexpr Curving recognised_tails{20};

inline constexpr bool is_recognition(Curving curving) {
    return curving == Curving::recognised || curving == recognised_even || curving == recognised_odd ||
           curving == recognised_heads || curving == recognised_tails;
}

} // namespace sahl

// In: nothing. Out: ways to meet a mesh that only pilot rays use, to tell how far the others can be trusted.
#pragma once

#include "geometry/bvh.h"
#include "geometry/recognise.h"

namespace sahl {

/// The fitted surface with the normals of each place taken from the polynomials of the farther corners.
inline constexpr Curving fitted_apart{16};

/// Recognised from half of the vertices alone, or from the rest; two numbers for each way to halve.
constexpr std::uint8_t first_half_number = 32;
inline constexpr Curving recognised_by(VertexShare share) {
    return share.way ? Curving(first_half_number + 2 * *share.way + (share.rest ? 1 : 0))
                     : Curving::recognised;
}
/// Of such a number, or `recognised`, what share of the vertices counts.
inline constexpr VertexShare vertices_for(Curving curving) {
    unsigned const number = static_cast<std::uint8_t>(curving);
    if (number < first_half_number)
        return {};
    return {(number - first_half_number) / 2, (number - first_half_number) % 2 == 1};
}

inline constexpr bool is_recognition(Curving curving) {
    return curving == Curving::recognised || static_cast<std::uint8_t>(curving) >= first_half_number;
}

} // namespace sahl

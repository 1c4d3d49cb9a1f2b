// In: numbers whose products nearly cancel. Out: their difference, with its digits.
#pragma once

#include "math/vec.h"

#include <cmath>

namespace sahl {

/// a·b − c·d to 1.5 ulp, however much cancels (C.-P. Jeannerod, N. Louvet, J.-M. Muller, Math. Comp. 82
/// (2013) 2245).
inline double difference_of_products(double a, double b, double c, double d) {
    double const cd = c * d;
    double const error = std::fma(-c, d, cd);
    return std::fma(a, b, -cd) + error;
}

/// a × b, each coordinate to 1.5 ulp: the normal of a needle of a triangle has digits only so.
inline dvec3 precise_cross(dvec3 const& a, dvec3 const& b) {
    return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
            difference_of_products(a.x, b.y, a.y, b.x)};
}

} // namespace sahl

// In: nothing. Out: vectors of numbers wider than double (64 and 113 bits), for the judges of the torture
// suite.
#pragma once

#include "math/vec.h"
#include "support/quad.h"

#include <cmath>

namespace sahl::bench {

using Long = long double;

inline Long root_of(Long x) {
    return x <= 0 ? Long(0) : std::sqrt(x);
}
inline Long absolute_of(Long x) {
    return x < 0 ? -x : x;
}

/// Half a unit in the last place of 1.
template <class T>
inline constexpr double roundoff = 0x1p-113;
template <>
inline constexpr double roundoff<Long> = 0x1p-64;

template <class T>
struct Wide3 {
    T x = 0, y = 0, z = 0;

    Wide3() = default;
    Wide3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
    explicit Wide3(dvec3 const& v) : x(v.x), y(v.y), z(v.z) {}
    friend Wide3 operator+(Wide3 const& a, Wide3 const& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Wide3 operator-(Wide3 const& a, Wide3 const& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Wide3 operator*(T s, Wide3 const& a) { return {s * a.x, s * a.y, s * a.z}; }
    friend T dot(Wide3 const& a, Wide3 const& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    /// Exactly −cross(b, a): two triangles find the same number at the edge between them.
    friend Wide3 cross(Wide3 const& a, Wide3 const& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
    friend T length(Wide3 const& a) { return root_of(dot(a, a)); }
    friend Wide3 normalize(Wide3 const& a) { return (1 / length(a)) * a; }
};

template <class T>
dvec3 narrow(Wide3<T> const& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// x ↦ columns · x + offset, and the way back.
template <class T>
struct WideAffine {
    Wide3<T> columns[3], rows_back[3], offset;

    explicit WideAffine(Affine const& map) : offset(map.offset) {
        for (int i = 0; i < 3; ++i)
            columns[i] = Wide3<T>(map.linear[i]);
        T const volume = dot(columns[0], cross(columns[1], columns[2]));
        for (int i = 0; i < 3; ++i)
            rows_back[i] = (1 / volume) * cross(columns[(i + 1) % 3], columns[(i + 2) % 3]);
    }
    Wide3<T> vector(Wide3<T> const& v) const {
        return v.x * columns[0] + v.y * columns[1] + v.z * columns[2];
    }
    Wide3<T> point(Wide3<T> const& p) const { return vector(p) + offset; }
    Wide3<T> vector_back(Wide3<T> const& v) const {
        return {dot(rows_back[0], v), dot(rows_back[1], v), dot(rows_back[2], v)};
    }
    Wide3<T> point_back(Wide3<T> const& p) const { return vector_back(p - offset); }
    /// Of a local surface's normal: unit, in the world.
    Wide3<T> normal(Wide3<T> const& n) const {
        return normalize(n.x * rows_back[0] + n.y * rows_back[1] + n.z * rows_back[2]);
    }
};

} // namespace sahl::bench

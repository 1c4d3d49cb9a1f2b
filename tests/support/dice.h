// In: a seed. Out: numbers, directions and angles drawn at random, the same on every machine.
#pragma once

#include "math/vec.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace sahl::bench {

class Dice {
  public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}

    /// [0, 1)
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * uniform(); }
    /// From low to high (> 0), each decade as likely as the next.
    double log_between(double low, double high) { return low * std::pow(high / low, uniform()); }
    std::uint64_t below(std::uint64_t count) { return engine_() % count; }
    double sign() { return engine_() & 1 ? 1.0 : -1.0; }

    /// Uniform over the sphere.
    dvec3 direction() {
        double const z = between(-1.0, 1.0), azimuth = 2.0 * std::numbers::pi * uniform();
        double const r = std::sqrt(1.0 - z * z);
        return normalize(dvec3(r * std::cos(azimuth), r * std::sin(azimuth), z));
    }
    dvec3 in_box(dvec3 const& low, dvec3 const& high) {
        double const x = uniform(), y = uniform(), z = uniform();
        return low + dvec3(x, y, z) * (high - low);
    }
    /// Columns: three orthogonal unit vectors, right-handed.
    dmat3 rotation() {
        dvec3 const x = direction();
        dvec3 const y = perpendicular_to(x, direction());
        return {x, y, cross(x, y)};
    }

  private:
    std::mt19937_64 engine_;
};

} // namespace sahl::bench

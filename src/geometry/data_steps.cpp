#include "geometry/data_steps.h"

#include "math/random.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sahl {

namespace {

bool is_float(double x) {
    return static_cast<double>(static_cast<float>(x)) == x;
}

double step_at(DataSteps const& steps, double x) {
    if (!steps.floats)
        return steps.even;
    float const magnitude = std::abs(static_cast<float>(x));
    return static_cast<double>(std::nextafter(magnitude, INFINITY)) - static_cast<double>(magnitude);
}

/// Equal for equal values.
std::uint64_t key_of(dvec3 const& v) {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
        key = mix64(key + std::bit_cast<std::uint64_t>(v[axis] + 0.0)); // −0 is 0
    return key;
}

double draw(std::uint64_t seed, dvec3 const& of, int axis) {
    return uniform(seed, key_of(of), 0, static_cast<std::uint32_t>(axis));
}

dvec3 stepped(DataSteps const& steps, dvec3 const& v, std::uint64_t seed) {
    dvec3 moved = v;
    for (int axis = 0; axis < 3; ++axis) {
        double const drawn = draw(seed, v, axis), step = step_at(steps, v[axis]);
        moved[axis] += drawn < 0.25 ? -step : drawn < 0.5 ? step : 0.0;
        if (steps.floats)
            moved[axis] = static_cast<double>(static_cast<float>(moved[axis]));
    }
    return moved;
}

} // namespace

DataSteps steps_of(std::span<dvec3 const> values) {
    DataSteps steps{true, 0.0};
    double greatest = 0.0;
    for (dvec3 const& v : values)
        for (int axis = 0; axis < 3; ++axis) {
            steps.floats = steps.floats && is_float(v[axis]);
            greatest = std::max(greatest, std::abs(v[axis]));
        }
    if (steps.floats || greatest == 0.0)
        return steps;
    int const first = static_cast<int>(std::floor(std::log10(greatest)));
    for (int power = first; power > first - 12; --power) {
        double const inverse = std::pow(10.0, -power); // exact where it matters: 10^0 … 10^22
        bool const all = std::all_of(values.begin(), values.end(), [&](dvec3 const& v) {
            dvec3 const whole = v * inverse;
            // half an ulp of the number, and as much of the product
            return length(whole - glm::round(whole)) <= 4.0 * 0x1p-53 * std::max(1.0, length(whole));
        });
        if (all)
            return {false, std::pow(10.0, power)};
    }
    return steps;
}

Mesh shaken(Mesh const& mesh, std::uint64_t seed) {
    Mesh moved = mesh;
    DataSteps const of_places = steps_of(mesh.soup.positions), of_normals = {true, 0.0};
    for (dvec3& p : moved.soup.positions)
        p = stepped(of_places, p, seed);
    for (FlatTriangle& flat : moved.flat)
        for (dvec3& p : flat.corners)
            p = stepped(of_places, p, seed);
    for (dvec3& n : moved.soup.normals) {
        dvec3 const was = n;
        for (int axis = 0; axis < 3; ++axis)
            n[axis] += shaken_by * step_at(of_normals, was[axis]) * (draw(seed, was, axis) - 0.5);
        n = normalize(n);
    }
    return moved;
}

} // namespace sahl

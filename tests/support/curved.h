// In: a soup and the normals of what it stands for. Out: a mesh as glTF carries it: places and normals in
// float.
#pragma once

#include "geometry/mesh.h"
#include "math/random.h"
#include "support/meshes.h"

#include <cmath>
#include <memory>

namespace sahl::bench {

/// GCC 12 leaves out two conversions of one vector that follow each other; a store in between keeps them.
inline double as_float(double x) {
    float volatile const rounded = static_cast<float>(x);
    return static_cast<double>(rounded);
}
inline dvec3 as_float(dvec3 const& v) {
    return {as_float(v.x), as_float(v.y), as_float(v.z)};
}

template <class NormalAt>
std::shared_ptr<Mesh const> float_mesh(TriangleSoup soup, NormalAt const& normal_at) {
    soup.normals.clear();
    for (dvec3 const& p : soup.positions)
        soup.normals.push_back(normalize(as_float(normal_at(p))));
    for (dvec3& p : soup.positions)
        p = as_float(p);
    return std::make_shared<Mesh const>(make_mesh(std::move(soup)));
}

/// A ball of 20 · frequency² triangles about the origin.
inline std::shared_ptr<Mesh const> float_ball(double radius, std::uint32_t frequency) {
    return float_mesh(geodesic_soup(radius, frequency), [](dvec3 const& p) { return normalize(p); });
}

/// The same with nothing rounded.
inline std::shared_ptr<Mesh const> double_ball(double radius, std::uint32_t frequency) {
    TriangleSoup soup = geodesic_soup(radius, frequency);
    soup.normals.clear();
    for (dvec3 const& p : soup.positions)
        soup.normals.push_back(normalize(p));
    return std::make_shared<Mesh const>(make_mesh(std::move(soup)));
}

/// A float ball with each place moved along the radius by up to `noise` of an edge, as a scanner leaves it,
/// and the normals that such a file has: those of the triangles, averaged.
inline std::shared_ptr<Mesh const> noisy_ball(double radius, std::uint32_t frequency, double noise) {
    TriangleSoup soup = geodesic_soup(radius, frequency);
    double const edge = 1.1 * radius / frequency;
    for (dvec3& p : soup.positions) { // by place: a vertex may be there more than once
        auto const key = [&](double x) {
            return static_cast<std::uint64_t>(std::llround(x / radius * 1e6 + 1e7));
        };
        p += noise * edge * (2.0 * uniform(key(p.x), key(p.y), key(p.z), 0) - 1.0) * normalize(p);
    }
    soup.normals.assign(soup.positions.size(), dvec3(0.0));
    for (auto const& [a, b, c] : soup.triangles) {
        dvec3 const across =
            cross(soup.positions[b] - soup.positions[a], soup.positions[c] - soup.positions[a]);
        for (std::uint32_t const corner : {a, b, c})
            soup.normals[corner] += across;
    }
    for (std::size_t i = 0; i < soup.positions.size(); ++i) {
        soup.normals[i] = normalize(as_float(normalize(soup.normals[i])));
        soup.positions[i] = as_float(soup.positions[i]);
    }
    return std::make_shared<Mesh const>(make_mesh(std::move(soup)));
}

} // namespace sahl::bench

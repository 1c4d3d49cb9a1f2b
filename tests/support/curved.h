// In: a soup and the normals of what it stands for. Out: a mesh as glTF carries it: places and normals in
// float.
#pragma once

#include "geometry/mesh.h"
#include "support/meshes.h"

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

} // namespace sahl::bench

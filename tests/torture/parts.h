// In: sizes. Out: parts of scenes that stand together in one group, exact and as meshes, and rays through
// them.
#pragma once

#include "torture/aim.h"
#include "torture/solids.h"

namespace sahl::bench {

inline Affine moved_by(Affine const& group, dvec3 const& offset) {
    return compose(group, Affine{dmat3(1.0), offset});
}

/// m: faces that were placed to touch in a group lie no farther apart.
inline double rounding_of(Affine const& group) {
    return 1e-14 * (length(group.linear[0]) + length(group.offset));
}

/// Where a case stands: at the origin as it is, or turned and moved.
inline Affine group_of(std::uint64_t salt, std::uint64_t variant, double far = 1.0) {
    Dice dice(salt + 31 * variant);
    return variant || far != 1.0 ? Affine{dice.rotation(), far * dice.direction()} : Affine{};
}

inline MeshRef block(dvec3 const& low, dvec3 const& high, bool other = false) {
    return mesh_of(box_soup(low, high, other));
}

inline TorturePart exact_block(dvec3 const& low, dvec3 const& high, std::uint32_t medium, Affine const& group,
                               int priority = 0) {
    return {Box{high - low}, medium, moved_by(group, 0.5 * (low + high)), priority};
}

using RayOf = std::function<TortureRay(Dice&, std::uint64_t)>;

/// Through any point of a box, in any direction.
inline RayOf anywhere(Affine const& group, dvec3 const& middle, dvec3 const& size, double before) {
    return [=](Dice& d, std::uint64_t) {
        return through(group,
                       middle + 0.5 * size * dvec3(d.between(-1, 1), d.between(-1, 1), d.between(-1, 1)),
                       d.direction(), before);
    };
}

inline void add(std::vector<TortureCase>& cases, std::string name, std::vector<double> indices,
                std::vector<TorturePart> parts, Affine const& group, RayOf ray, Rule rule = Rule::either,
                bool faces = true) {
    TortureCase made{std::move(name), "mixed", std::move(indices), std::move(parts), std::move(ray), rule};
    made.contact = rounding_of(group);
    made.faces = faces;
    cases.push_back(std::move(made));
}

} // namespace sahl::bench

// In: the keys scale, turn_deg, move_mm or matrix, and the groups. Out: affine maps to the world.
#pragma once

#include "math/vec.h"
#include "scene/read_table.h"

#include <map>
#include <string>
#include <vector>

namespace sahl {

/// Sine and cosine of an angle in degrees, exact at every multiple of 90°, and at those of 30° where a double
/// can be.
double sin_of_deg(double angle_deg);
double cos_of_deg(double angle_deg);

/// Turned about x, then about y, then about z, right-handed.
dmat3 turn(dvec3 const& angles_deg);

/// Scale, then turn, then move; or the matrix. Throws InputError where the map cannot be inverted.
Affine read_transform(Fields const& fields);

/// The groups by name, each with the motion of those it belongs to.
using Groups = std::map<std::string, Affine>;

/// Throws InputError: a name twice, an unknown parent, groups that belong to each other.
Groups read_groups(Array const& tables);

/// The motion of the group that `fields` names under `group`, or none.
Affine group_of(Fields const& fields, Groups const& groups);

/// The same where the group turns and moves only. Throws InputError where it scales or mirrors.
Affine rigid_group_of(Fields const& fields, Groups const& groups);

dvec3 vector_of(std::vector<double> const& three);

/// Three lengths given in mm, in m.
dvec3 metres(std::vector<double> const& three_mm);

/// A length given in mm, in m.
inline double metres(double mm) {
    return mm / 1000.0;
}

/// A unit vector along the direction under `key`, after `map`. Throws InputError where it has no length.
dvec3 read_direction(Fields const& fields, std::string_view key, Affine const& map);

/// A unit vector at right angles to `axis`, along the direction under `key` if there is one.
/// Throws InputError where that is parallel to the axis.
dvec3 read_up(Fields const& fields, std::string_view key, dvec3 const& axis, Affine const& map);

} // namespace sahl

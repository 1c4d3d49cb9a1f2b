// In: the health of a mesh and where it stands. Out: the same as a tree of values in millimetres of the
// world, and as remarks for a person.
#pragma once

#include "geometry/mesh_health.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace sahl {

/// What a check has to say, by what follows from it.
struct Remarks {
    std::vector<std::string> problems; // the results would be wrong, or there would be none
    std::vector<std::string> warnings; // it is traced, but perhaps not as meant
    std::vector<std::string> notes;    // what was mended, or what is good to know

    void add(Remarks const& other);
};

/// The keys are listed in docs/check.md. Lengths are those of the world where `to_world` is a similarity;
/// otherwise sums of lengths and areas are by its mean scale.
Value health_value(Mesh const& mesh, MeshHealth const& health, Affine const& to_world);

/// Each remark begins with the name. `body`: it is to have an inside.
Remarks health_remarks(std::string const& name, Mesh const& mesh, MeshHealth const& health,
                       Affine const& to_world, bool body);

/// Of one that is traced in fewer triangles: how many, of how many, how far what is left out lies off them,
/// and how far that turns directions.
Value decimation_value(Body const& body);

/// Health by body. Each mesh is looked at once: of its instances the first has the report, in its own place,
/// and the others say which that is. What there is to say of the meshes is added to `remarks`, if given.
Value models_value(Scene const& scene, bool look_for_intersections, Remarks* remarks = nullptr);

/// Nothing for a size (m) that optics often has, 0.1 mm to 5 m. Otherwise what the same number would be in
/// the units that files are often in; `metres_per_unit` is that of the file.
std::string unit_doubt(double size, double metres_per_unit);

} // namespace sahl

// In: a mesh of a model, its materials, and what the experiment maps them to. Out: the bodies and open
// surfaces that it is traced as.
#pragma once

#include "scene/model.h"
#include "scene/model_cache.h"
#include "scene/model_material.h"
#include "scene/scene.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sahl {

/// Shells of a mesh that make one body of one medium, or its open surfaces.
struct ModelPart {
    std::shared_ptr<Mesh const> mesh;
    bool open = false;
    std::optional<MediumId> medium;                 // of a body that light can be in
    std::string label;                              // for a name, where a mesh has several parts
    std::vector<std::optional<SurfaceId>> surfaces; // by face
};

/// The parts of one mesh, which all its instances share; larger ones first, so that what lies inside another
/// is there. A mapping of the experiment goes before the object's medium and surface, and those before what
/// the file says. A closed component of glass is a body. An open one is a thin wall of glass or a surface,
/// unless the experiment itself says what medium it is: then a body with holes. Throws InputError where
/// nothing says what a component is made of.
std::vector<ModelPart> parts_of(ObjectSpec const& object, ModelReference const& reference, ModelCache& cache,
                                std::shared_ptr<Model const> const& model, std::size_t mesh,
                                MaterialBook& materials);

/// Interpolated where the mesh has normals, unless the experiment asks for one method. A curved surface is
/// that of a closed mesh or of an open one without an inside: of a body with holes the vertices' normals are
/// taken.
///   open   a surface, no body
Method object_method(Mesh const& mesh, bool open, Method asked);

/// How the geometry meets a mesh that is traced by this method.
Curving curving_of(Method method);

} // namespace sahl

// In: a model's materials and what the experiment maps them to. Out: what its bodies and their faces are made
// of.
#pragma once

#include "math/input_error.h"
#include "scene/model.h"
#include "scene/scene.h"

namespace sahl {

struct ModelBody {
    MediumId medium;
    std::vector<std::optional<SurfaceId>> surfaces; // by face
};

/// Media and surfaces that only the file describes are added to the scene. A mapping of the experiment goes
/// before the object's medium and surface, and those before what the file says.
ModelBody body_of(ObjectSpec const& object, ModelReference const& reference, Model const& model,
                  ModelMesh const& mesh, Scene& scene);

/// Does the experiment want the instance of this name?
bool wants_part(ModelReference const& reference, std::string const& instance);
InputError no_such_part(ModelReference const& reference, Model const& model);

/// Throws where the experiment maps a material that the model does not have.
void check_mapping(ModelReference const& reference, Model const& model);

/// "object.node", with dots replaced and a number added where it is taken.
std::string unique_name(Scene const& scene, std::string const& object, std::string node);

/// Interpolated where the mesh has normals, unless the experiment asks for one method.
Method object_method(Mesh const& mesh, Method asked);

} // namespace sahl

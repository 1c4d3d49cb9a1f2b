// In: a scene, and how each of its meshes is to be met. Out: its geometry met so. Models are not read again.
#pragma once

#include "scene/scene.h"

#include <memory>
#include <span>

namespace sahl {

struct BodyMethod {
    bool interpolate = false;
    Curving curving = Curving::none;
};

/// As build_scene made it, with other methods; by body, those without a mesh as they are.
///   store   as Bvh has it
std::unique_ptr<Bvh const> bvh_with(Scene const& scene, std::span<BodyMethod const> methods,
                                    MeshStore* store = nullptr);

BodyMethod body_method(Method method);

/// As in an experiment file.
char const* name_of(Method method);

} // namespace sahl

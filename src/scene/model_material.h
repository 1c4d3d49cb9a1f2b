// In: a material as a model file describes it. Out: the medium and the surface that light meets, added to the
// scene.
#pragma once

#include "scene/model.h"
#include "scene/scene.h"

#include <optional>
#include <string>

namespace sahl {

/// Does light go into it? Metal and an ideal mirror (ior 0) let none in.
bool is_glass(ModelMaterial const& material);

/// Materials of one model in one scene, under names "object:material". What a material leaves out or means is
/// told once.
class MaterialBook {
  public:
    /// metres_per_unit   of the model's lengths, in which it gives the attenuation distance
    MaterialBook(Scene& scene, std::string object, double metres_per_unit)
        : scene_(scene), object_(std::move(object)), metres_per_unit_(metres_per_unit) {}

    /// What is inside a closed boundary of glass.
    MediumId medium(ModelMaterial const& material);
    /// What the boundary of a body does; none: no more than its media.
    std::optional<SurfaceId> boundary(ModelMaterial const& material);
    /// What an open surface does: glass is a thin wall.
    SurfaceId sheet(ModelMaterial const& material);
    /// The same of a medium that the experiment names.
    SurfaceId wall(MediumId medium);

    void warn(std::string const& text);

  private:
    SurfaceId add(ModelMaterial const& material, std::string const& name, Surface surface);
    void warn_of_tint(ModelMaterial const& material, bool thin);

    Scene& scene_;
    std::string object_;
    double metres_per_unit_;
};

} // namespace sahl

// In: the pictures that a scene's surfaces take their colours from. Out: the colour at a place where light
// arrives.
#pragma once

#include "image/texture.h"
#include "scene/interface.h"

#include <memory>
#include <string>
#include <vector>

namespace sahl {

/// The pictures of a scene, read.
class SurfaceTextures {
  public:
    /// Reads each picture once; tracing needs none. Throws InputError where one that the experiment names
    /// cannot be read; what a model names and cannot be read is white, with a warning.
    explicit SurfaceTextures(Scene const& scene);

    bool empty() const { return textures_.empty(); }
    std::vector<std::string> const& warnings() const { return warnings_; }

    bool has(Scene const& scene, Interface const& interface) const;

    /// What the surface's colour is multiplied by, linear RGB; white where it has no picture.
    /// dx, dy   how the place moves in the world over the width and the height of what is looked with; zero:
    /// a point
    dvec3 at(Scene const& scene, Interface const& interface, dvec3 const& dx = dvec3(0.0),
             dvec3 const& dy = dvec3(0.0)) const;

  private:
    std::vector<std::shared_ptr<Texture const>> textures_; // by TextureId; null: white
    std::vector<std::string> warnings_;
};

} // namespace sahl

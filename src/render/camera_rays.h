// In: a camera and a place on its film. Out: the ray that comes in there, followed backwards.
#pragma once

#include "math/sequences.h"
#include "render/footprint.h"
#include "scene/picture.h"

#include <cmath>

namespace sahl {

struct CameraRay {
    dvec3 origin, direction; // direction: unit
};

class CameraRays {
  public:
    explicit CameraRays(Camera const& camera)
        : camera_(camera), right_(camera.right()),
          half_height_(camera.height > 0.0 ? 0.5 * camera.height : std::tan(0.5 * camera.fov)),
          half_width_(half_height_ * camera.columns / camera.rows) {}

    /// All rays begin at one point.
    bool from_one_point() const { return camera_.height == 0.0 && camera_.lens_radius == 0.0; }
    Camera const& camera() const { return camera_; }

    /// film   in pixels, (0, 0) the picture's upper left corner
    /// lens   in [0, 1)², a place on the lens
    CameraRay ray(dvec2 const& film, dvec2 const& lens) const {
        double const x = (2.0 * film.x / camera_.columns - 1.0) * half_width_;
        double const y = (1.0 - 2.0 * film.y / camera_.rows) * half_height_;
        dvec3 const across = x * right_ + y * camera_.up;
        CameraRay ray = camera_.height > 0.0 ? CameraRay{camera_.at + across, camera_.forward}
                                             : CameraRay{camera_.at, camera_.forward + across};
        if (camera_.lens_radius > 0.0) {
            dvec3 const sharp = ray.origin + camera_.focus * ray.direction;
            dvec2 const disk = camera_.lens_radius * disk_from_square(lens);
            ray.origin += disk.x * right_ + disk.y * camera_.up;
            ray.direction = sharp - ray.origin;
        }
        ray.direction = normalize(ray.direction);
        return ray;
    }

    /// Of a ray that `ray` gave, for steps of so many pixels.
    Footprint footprint(dvec3 const& direction, double pixels) const {
        dvec3 const across = 2.0 * half_width_ * pixels / camera_.columns * right_;
        dvec3 const down = -2.0 * half_height_ * pixels / camera_.rows * camera_.up;
        if (camera_.height > 0.0)
            return {{across, dvec3(0.0)}, {down, dvec3(0.0)}};
        // before it was made a unit vector the direction reached a distance of 1 along `forward`
        double const shortened = dot(direction, camera_.forward);
        auto const heading = [&](dvec3 const& step) {
            return shortened * (step - dot(step, direction) * direction);
        };
        return {{dvec3(0.0), heading(across)}, {dvec3(0.0), heading(down)}};
    }

  private:
    Camera camera_;
    dvec3 right_;
    double half_height_, half_width_; // at a distance of 1, or m of an orthographic one
};

} // namespace sahl

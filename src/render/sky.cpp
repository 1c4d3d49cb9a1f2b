#include "render/sky.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

/// From the world to the image's frame: `up` is its y, and the image is turned about that.
dmat3 image_frame(Background const& background) {
    dvec3 const& up = background.up;
    dvec3 const back = perpendicular_to(up, dvec3(0.0, 0.0, 1.0)), right = cross(up, back);
    double const c = std::cos(background.turn), s = std::sin(background.turn);
    return glm::transpose(dmat3(c * right - s * back, up, s * right + c * back));
}

} // namespace

Sky::Sky(Background const& background) : background_(background) {
    if (!background.image.empty())
        environment_.emplace(read_image(background.image), image_frame(background));
}

dvec3 Sky::toward(dvec3 const& direction, dvec3 const& across, dvec3 const& down) const {
    if (environment_)
        return environment_->at(direction, across, down);
    if (!background_.zenith)
        return background_.color;
    double const up = std::max(0.0, dot(direction, background_.up));
    return background_.color + up * (*background_.zenith - background_.color);
}

} // namespace sahl

#include "render/sky.h"

#include "math/input_error.h"

#include <algorithm>

namespace sahl {

Sky::Sky(Background const& background) : background_(background) {
    if (!background.image.empty())
        throw InputError(background.place.text(), "backgrounds that are images are not read yet",
                         "give color, or color and zenith");
}

dvec3 Sky::toward(dvec3 const& direction) const {
    if (!background_.zenith)
        return background_.color;
    double const up = std::max(0.0, dot(direction, background_.up));
    return background_.color + up * (*background_.zenith - background_.color);
}

} // namespace sahl

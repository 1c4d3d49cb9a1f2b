#include "render/light_map.h"

#include <algorithm>
#include <cmath>

namespace sahl {

void LightMap::add(dvec2 const& at, dvec3 const& light) {
    auto const place = [](double share, std::uint32_t count) {
        return static_cast<std::size_t>(std::clamp(std::floor(share * count), 0.0, count - 1.0));
    };
    light_[place(0.5 + at.y / size_.y, rows_) * columns_ + place(0.5 + at.x / size_.x, columns_)] += light;
}

dvec3 LightMap::pixel(double x, double y) const {
    auto const column = static_cast<std::size_t>(std::clamp(x, 0.0, columns_ - 1.0));
    auto const row = static_cast<std::size_t>(std::clamp(y, 0.0, rows_ - 1.0));
    return light_[row * columns_ + column];
}

dvec3 LightMap::at(dvec3 const& point) const {
    dvec3 const own = to_own_.point(point);
    if (std::abs(own.z) > on_rectangle * std::max(size_.x, size_.y) || std::abs(own.x) > 0.5 * size_.x ||
        std::abs(own.y) > 0.5 * size_.y)
        return dvec3(0.0);
    double const x = (0.5 + own.x / size_.x) * columns_ - 0.5, y = (0.5 + own.y / size_.y) * rows_ - 0.5;
    double const left = std::floor(x), below = std::floor(y), across = x - left, up = y - below;
    return (1.0 - up) * ((1.0 - across) * pixel(left, below) + across * pixel(left + 1.0, below)) +
           up * ((1.0 - across) * pixel(left, below + 1.0) + across * pixel(left + 1.0, below + 1.0));
}

} // namespace sahl

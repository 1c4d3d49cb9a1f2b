#include "image/texture.h"

#include <algorithm>
#include <cmath>

namespace sahl {
namespace {

constexpr double most_looks = 16.0; // along a footprint; one that is longer still is blurred across too

double finite_or_0(double number) {
    return std::isfinite(number) ? number : 0.0;
}

dvec2 finite_or_0(dvec2 const& v) {
    return {finite_or_0(v.x), finite_or_0(v.y)};
}

/// The column or row, 0 to size − 1, that stands for number `i`, −1 to size: a look's neighbours go one
/// beyond.
std::uint32_t wrapped(std::int64_t i, std::uint32_t size, Wrap wrap) {
    std::int64_t const last = static_cast<std::int64_t>(size) - 1;
    if (i >= 0 && i <= last)
        return static_cast<std::uint32_t>(i);
    if (wrap == Wrap::repeat)
        return static_cast<std::uint32_t>(i < 0 ? last : 0);
    return static_cast<std::uint32_t>(i < 0 ? 0 : last);
}

/// A coordinate brought back to [0, 1].
double folded(double u, Wrap wrap) {
    switch (wrap) {
    case Wrap::repeat:
        return u - std::floor(u);
    case Wrap::mirror:
        return 1.0 - std::abs(1.0 - (u - 2.0 * std::floor(0.5 * u)));
    case Wrap::clamp:
        break;
    }
    return std::clamp(u, 0.0, 1.0);
}

/// Which pixels of a side of `size` one of `count` parts covers, and the share of each, in the part's mean.
template <class Take>
void for_each_covered(std::uint32_t part, std::uint32_t count, std::uint32_t size, Take const& take) {
    double const begin = static_cast<double>(part) * size / count;
    double const end = static_cast<double>(part + 1) * size / count;
    for (std::uint32_t i = static_cast<std::uint32_t>(begin); i < size && i < end; ++i) {
        double const covered = std::min<double>(end, i + 1.0) - std::max<double>(begin, i);
        take(i, covered / (end - begin));
    }
}

} // namespace

double linear_of_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Texture::Texture(Image const& image, Wrap across, Wrap up) : across_(across), up_(up) {
    Level level{image.width, image.height, {}};
    std::size_t const count = std::size_t{image.width} * image.height;
    level.pixels.resize(count);
    bool const colour = image.channels >= 3;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            float const value = image.pixels[i * image.channels + (colour ? c : 0)];
            double const linear = image.encoded ? linear_of_srgb(value) : static_cast<double>(value);
            level.pixels[i][c] = static_cast<float>(finite_or_0(linear));
        }
    levels_.push_back(std::move(level));
    while (levels_.back().width > 1 || levels_.back().height > 1)
        levels_.push_back(halved(levels_.back()));
}

/// Where a side is odd, pixels on the borders of two parts count in both, by the share that lies in each.
Texture::Level Texture::halved(Level const& level) {
    Level half{std::max(1U, level.width / 2), std::max(1U, level.height / 2), {}};
    half.pixels.reserve(std::size_t{half.width} * half.height);
    for (std::uint32_t row = 0; row < half.height; ++row)
        for (std::uint32_t column = 0; column < half.width; ++column) {
            dvec3 sum(0.0);
            for_each_covered(row, half.height, level.height, [&](std::uint32_t y, double share_y) {
                for_each_covered(column, half.width, level.width, [&](std::uint32_t x, double share_x) {
                    Pixel const& pixel = level.pixels[std::size_t{y} * level.width + x];
                    sum += share_x * share_y * dvec3(pixel[0], pixel[1], pixel[2]);
                });
            });
            half.pixels.push_back(
                {static_cast<float>(sum.x), static_cast<float>(sum.y), static_cast<float>(sum.z)});
        }
    return half;
}

dvec3 Texture::mean() const {
    Pixel const& pixel = levels_.back().pixels.front();
    return {pixel[0], pixel[1], pixel[2]};
}

dvec3 Texture::in_level(std::size_t number, dvec2 const& uv) const {
    Level const& level = levels_[number];
    double const x = folded(uv.x, across_) * level.width - 0.5;
    double const y = (1.0 - folded(uv.y, up_)) * level.height - 0.5;
    double const left = std::floor(x), top = std::floor(y);
    dvec3 sum(0.0);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            double const share = (i ? x - left : 1.0 - (x - left)) * (j ? y - top : 1.0 - (y - top));
            std::uint32_t const column = wrapped(static_cast<std::int64_t>(left) + i, level.width, across_);
            std::uint32_t const row = wrapped(static_cast<std::int64_t>(top) + j, level.height, up_);
            Pixel const& pixel = level.pixels[std::size_t{row} * level.width + column];
            sum += share * dvec3(pixel[0], pixel[1], pixel[2]);
        }
    return sum;
}

dvec3 Texture::between_levels(double level, dvec2 const& uv) const {
    double const last = static_cast<double>(levels_.size() - 1);
    double const lower = std::floor(std::clamp(level, 0.0, last));
    double const share = std::clamp(level, 0.0, last) - lower;
    dvec3 const fine = in_level(static_cast<std::size_t>(lower), uv);
    return share > 0.0 ? (1.0 - share) * fine + share * in_level(static_cast<std::size_t>(lower) + 1, uv)
                       : fine;
}

dvec3 Texture::at(dvec2 uv, dvec2 du, dvec2 dv) const {
    uv = finite_or_0(uv);
    dvec2 const size(width(), height());
    dvec2 longer = finite_or_0(du), shorter = finite_or_0(dv);
    if (length(longer * size) < length(shorter * size))
        std::swap(longer, shorter);
    double const along = length(longer * size); // pixels
    if (!(along > 1.0))
        return in_level(0, uv);
    dvec2 const a = longer * size, b = shorter * size;
    // as wide as the parallelogram is at right angles to its longer side, and no finer than a pixel
    double const across = std::max(1.0, std::abs(a.x * b.y - a.y * b.x) / along);
    double const looks = std::min(most_looks, std::ceil(along / across));
    double const level = std::log2(std::max(across, along / looks));
    dvec3 sum(0.0);
    for (double i = 0.5; i < looks; i += 1.0)
        sum += between_levels(level, uv + (i / looks - 0.5) * longer);
    return sum / looks;
}

} // namespace sahl

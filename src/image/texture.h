// In: a picture, and places on it with the width of what looks at them. Out: its colour there, linear,
// filtered.
#pragma once

#include "image/image.h"
#include "math/vec.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sahl {

/// How a picture goes on beyond its borders.
enum class Wrap { repeat, mirror, clamp };

/// Linear values of an encoded one (IEC 61966-2-1). In and out [0, 1].
double linear_of_srgb(double encoded);

/// A picture with its means over ever larger squares (Williams 1983, "Pyramidal parametrics"): each level has
/// half the columns and rows of the one before, and the same mean. Alpha is left out; one channel is grey.
class Texture {
  public:
    /// image   at least one pixel; an encoded one is made linear before anything is averaged
    explicit Texture(Image const& image, Wrap across = Wrap::repeat, Wrap up = Wrap::repeat);

    /// The colour about `uv`, linear RGB: between pixels' centres linear, and averaged where a footprint
    /// covers many pixels (a row of at most 16 trilinear looks along the longer side: McCormack et al. 1999,
    /// "Feline"). uv       from the left and from the bottom, 0 to 1 once over the picture du, dv   the sides
    /// of the footprint, in the same units; zero: a point What is not finite counts as 0.
    dvec3 at(dvec2 uv, dvec2 du = dvec2(0.0), dvec2 dv = dvec2(0.0)) const;

    std::uint32_t width() const { return levels_.front().width; }
    std::uint32_t height() const { return levels_.front().height; }
    /// The mean over the whole picture.
    dvec3 mean() const;

  private:
    using Pixel = std::array<float, 3>;
    struct Level {
        std::uint32_t width, height;
        std::vector<Pixel> pixels; // row by row, the first at the top
    };
    static Level halved(Level const& level);
    dvec3 in_level(std::size_t level, dvec2 const& uv) const;
    dvec3 between_levels(double level, dvec2 const& uv) const;

    std::vector<Level> levels_;
    Wrap across_, up_;
};

/// The most pixels of a picture that is made a Texture: a gigabyte with its levels.
constexpr std::uint64_t most_texture_pixels = std::uint64_t{1} << 26;

} // namespace sahl
